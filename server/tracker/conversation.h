// The life of a tracker on an open line, the same for all families: set it up, listen, start it again when it falls
// silent (with ever longer pauses), leave it quiet at the end. One thread, the driver's.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include "server/tracker/line.h"
#include "server/tracker/preferences.h"
#include "server/tracker/session.h"
#include "server/tracker/status_board.h"

namespace posed::tracker {

class Capture;

class Conversation {
 public:
  using Milliseconds = std::chrono::milliseconds;

  // `capture` may be null.
  Conversation(Line& line, Session& session, StatusBoard& board, Capture* capture, const PreferenceBox& preferences,
               const std::atomic<bool>& stopping);
  void run();  // until `stopping` or the line is in trouble

  // For sessions.
  Preferences preferences() const { return preferences_.get(); }  // of this set-up
  bool alive() const { return !stopping_ && line_.trouble() == Line::Trouble::none; }
  bool write(std::string_view bytes) { return line_.write(bytes); }
  // Sends `stops` one after the other until the device is quiet; what it says meanwhile is thrown away. A program that
  // crashed leaves a device streaming, with its buffer full and perhaps half a command typed. A slow one complains of
  // that later: nothing is made of complaints before the first answer to a question.
  bool make_quiet(std::initializer_list<std::string_view> stops);
  // Sends `question` up to three times until `answered`; decodes meanwhile.
  bool ask(std::string_view question, const std::function<bool()>& answered);
  void begin(int highest_station);     // the session has a fresh decoder; 0: the stations are not known
  void trouble(std::string message);   // why there is no stream, or would be none: told once it is silent
  void complain(std::string message);  // told until the next set-up, whether it streams or not
  void nominal_rate(double hz) { board_.set_rate(hz); }

 private:
  // While frames come; returns when none has come for so long, or when other things are asked of the device.
  void listen(Milliseconds patience);
  bool asked_anew() const { return preferences_.version() != heeded_; }
  void rest();  // as long as the line lasts
  void hear();
  std::string all_trouble() const;

  Line& line_;
  Session& session_;
  StatusBoard& board_;
  Capture* capture_;
  const PreferenceBox& preferences_;
  const std::atomic<bool>& stopping_;
  std::uint64_t heeded_ = 0;  // of the preferences: that the last set-up knew
  bool begun_ = false;        // since the last set-up began
  bool forgiving_ = false;    // complaints are of what stood half typed
  std::string trouble_;
  std::string complaint_;
};

// Why there is no answer, and what to do. `name`: of the family, as people write it; 0 baud: on USB.
std::string no_answer(std::string_view name, unsigned baud);

}  // namespace posed::tracker
