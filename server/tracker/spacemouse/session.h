// A SpaceMouse needs no words: it is listened to, and silent while its cap rests.
#pragma once

#include <string>
#include <utility>

#include "server/tracker/session.h"
#include "server/tracker/spacemouse/decoder.h"

namespace posed::tracker {

class SpacemouseSession final : public Session {
 public:
  explicit SpacemouseSession(std::string id) : decoder_(SpacemouseFormat{std::move(id)}) {}

  Decoder& decoder() override { return decoder_; }
  bool set_up(Conversation& with) override;
  void hear(const Reply&, Conversation&) override {}
  void leave(Conversation&) override {}
  bool may_rest() const override { return true; }

 private:
  SpacemouseDecoder decoder_;
};

}  // namespace posed::tracker
