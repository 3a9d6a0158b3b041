// What one family says on its line, and understands: the part of a conversation that differs between families. Made
// anew for each opened line; one thread, the driver's.
#pragma once

#include "server/tracker/decoder.h"

namespace posed::tracker {

class Conversation;

class Session {
 public:
  virtual ~Session() = default;
  virtual Decoder& decoder() = 0;
  // Makes the device quiet, sets it up and starts its stream. False: the line is in trouble, or the conversation was
  // told what is wrong (Conversation::trouble).
  virtual bool set_up(Conversation& with) = 0;
  virtual void hear(const Reply& reply, Conversation& with) = 0;
  virtual void leave(Conversation& with) = 0;      // stops the stream
  virtual bool may_rest() const { return false; }  // silence is no trouble
};

}  // namespace posed::tracker
