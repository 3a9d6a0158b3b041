// A face is one of the ways in which the port is spoken to. It makes sense of the bytes that come in; its link, the
// connection beneath, does the rest. All on the network thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "common/result.h"
#include "common/time.h"
#include "server/net/subscription.h"

namespace posed::net {

class Face {
 public:
  virtual ~Face() = default;
  // Bytes in any portions; none to go on with what is held already.
  virtual void take(std::string_view bytes) = 0;
  // Holds input that it could not deal with for want of room: no more is read.
  virtual bool stuck() const = 0;
  // Is stuck, but could go on now.
  virtual bool ready() const = 0;
  // The peer sends no more. Called once, with everything before it taken.
  virtual void end() {}
  // A sign of life that the peer must answer, if this face knows one.
  virtual SharedLine heartbeat() const { return nullptr; }
  // The last bytes before the connection is closed, if this face has any.
  virtual SharedLine goodbye(std::uint16_t close_code) const { return (void)close_code, nullptr; }
};

class Link {
 public:
  enum class Owed { wait, forget };

  virtual bool room() const = 0;  // for further lines: few enough are unanswered or unread
  virtual bool idle() const = 0;  // all was sent
  virtual bool may_ask() = 0;     // for a page; false: it has had its share for now
  virtual void hand_up(std::string_view line) = 0;
  virtual void send(SharedLine bytes) = 0;  // as they are
  virtual void open(bool websocket) = 0;    // from here on the peer speaks the protocol
  virtual void become(std::unique_ptr<Face> face, std::string_view rest) = 0;
  virtual void deadline(Nanoseconds in) = 0;  // to be closed then; 0: never
  // Reads no more; answers what is owed (if it is waited for), sends the last words, closes.
  virtual void part(std::uint16_t close_code, std::optional<Error> last_words, Owed owed) = 0;

 protected:
  ~Link() = default;
};

}  // namespace posed::net
