// The way back for one request. Call one of its functions, once, on the station loop, now or later; the line goes out
// when all requests of the peer's line have been answered.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/log.h"
#include "proto/codec.h"
#include "server/net/server.h"

namespace posed {

class Responder {
 public:
  // One line of a peer, with as many answers as it has entries.
  struct Answers {
    net::Server& server;
    net::ConnectionId connection;
    bool batch;
    std::vector<std::string> texts;
    std::size_t missing;
  };

  Responder(std::shared_ptr<Answers> answers, std::size_t index, std::string id)
      : answers_(std::move(answers)), index_(index), id_(std::move(id)) {}

  template <class Message>
  void result(const Message& message) {
    deliver(id_.empty() ? std::string() : proto::encode_reply(id_, message));
  }
  void error(const Error& error) {
    if (id_.empty()) log_debug("a notification failed: " + error.message);
    deliver(id_.empty() ? std::string() : proto::encode_error(id_, error));
  }
  // The reply to a result that is text already, and a notice on the way to it. From any thread.
  std::string reply_text(std::string_view result) const {
    return id_.empty() ? std::string() : proto::encode_reply_text(id_, result);
  }
  std::string progress_text(std::size_t done, std::size_t of) const { return proto::encode_progress(id_, done, of); }
  bool wanted() const { return !id_.empty(); }

  // An error of the scene, whose paths begin at the parameters.
  void params_error(Error error) {
    if (!error.path.empty()) error.path = "/params" + error.path;
    this->error(error);
  }

  // A text of reply_text.
  void deliver(std::string text) {
    Answers& a = *answers_;
    a.texts[index_] = std::move(text);
    if (--a.missing > 0) return;
    std::string line = a.batch ? proto::join_batch(a.texts) : std::move(a.texts[0]);
    a.server.reply(a.connection, line.empty() ? nullptr : std::make_shared<const std::string>(std::move(line)));
  }

 private:
  std::shared_ptr<Answers> answers_;
  std::size_t index_;
  std::string id_;
};

}  // namespace posed
