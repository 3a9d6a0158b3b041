// What a VIPER is told. It acknowledges every command, also between the frames of a stream.
// Source: the SDK's protocol headers and the order of the public drivers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/tracker/preferences.h"
#include "server/tracker/session.h"
#include "server/tracker/viper/decoder.h"
#include "server/tracker/viper/frame.h"

namespace posed::tracker {

// What tracker.configure may ask of it, and what it is from the factory.
Abilities viper_abilities();
Preferences viper_defaults();

struct ViperOptions {
  std::string id = "viper";
};

class ViperSession final : public Session {
 public:
  explicit ViperSession(ViperOptions options);

  Decoder& decoder() override { return decoder_; }
  bool set_up(Conversation& with) override;
  void hear(const Reply& reply, Conversation& with) override;
  void leave(Conversation& with) override;

 private:
  // The answer's payload; nothing where it refuses, or does not answer: the conversation was told which.
  std::optional<std::vector<std::uint8_t>> ask(ViperCommand command, ViperAction action, Conversation& with,
                                               std::span<const std::uint32_t> payload = {});
  // What has been asked of it; a refusal is told, and the stream goes on without.
  bool prefer(Conversation& with);
  // The answer, where there is one.
  const Reply* tell(ViperCommand command, std::span<const std::uint32_t> payload, ViperArguments about,
                    Conversation& with);

  ViperOptions options_;
  ViperDecoder decoder_;
  std::map<std::uint32_t, Reply> replies_;  // the newest of each command
};

}  // namespace posed::tracker
