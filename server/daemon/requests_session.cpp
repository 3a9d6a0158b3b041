// Lines, sessions and streams.
#include <random>
#include <utility>

#include "common/names.h"
#include "server/daemon/requests.h"

namespace posed {
namespace {

const proto::Software kDaemon{"posed", POSED_VERSION};

}  // namespace

std::string random_key() {
  constexpr char kDigits[] = "0123456789abcdef";
  std::random_device device;
  std::string key;
  for (int i = 0; i < 32; ++i) key += kDigits[device() & 15u];
  return key;
}

void Requests::handle(proto::Line line) {
  const std::size_t count = line.entries.size();
  const auto answers = std::make_shared<Responder::Answers>(
      Responder::Answers{p_.server, connection_, line.batch, std::vector<std::string>(count), count});
  if (count == 0) return p_.server.reply(connection_, nullptr);
  for (std::size_t i = 0; i < count; ++i) {
    if (const auto* bad = std::get_if<proto::BadRequest>(&line.entries[i])) {
      Responder(answers, i, bad->id).error(bad->error);
      continue;
    }
    auto& request = std::get<proto::Request>(line.entries[i]);
    if (const Status checked = allowed(request.params); !checked) {
      Responder(answers, i, request.id).error(checked.error());
      continue;
    }
    if_revision_ = request.if_revision;
    method_ = proto::method_name(request.params);
    label_.clear();
    gesture_ = std::move(request.gesture);
    once_ = std::move(request.once);
    force_ = request.force;
    std::visit([&](auto& params) { on(params, Responder(answers, i, request.id)); }, request.params);
  }
}

// By the role that the connection's token has given it.
Status Requests::allowed(const proto::Params& params) const {
  if (!p_.tokens) return Ok{};
  const auto session = p_.sessions.find(connection_);
  const proto::Role role = session == p_.sessions.end() ? proto::Role::none : session->second.role;
  const proto::Role needed = proto::role_for(params);
  if (role >= needed) return Ok{};
  const std::string method(proto::method_name(params));
  if (role == proto::Role::none)
    return Error{"unauthorized", method + " wants a token", "/method", "say session.hello with your \"token\" first"};
  return Error{"forbidden", std::string(proto::name_of(role)) + "s may not call " + method, "/method",
               "ask for a token with the role " + std::string(proto::name_of(needed))};
}

void Requests::on(const proto::SessionHello& hello, Responder responder) {
  std::optional<net::Tokens::Holder> holder;
  if (p_.tokens) {
    holder = p_.tokens->find(hello.token);
    if (!holder) {
      const auto session = p_.sessions.find(connection_);
      if (session != p_.sessions.end() && !std::exchange(session->second.token_refused, true))
        log_warning("a token of " + session->second.peer.address + " was refused");
      return responder.error({"unauthorized",
                              hello.token.empty() ? "this daemon asks for a token" : "nobody has this token",
                              "/params/token", "as in session.hello {\"token\":\"…\"}; posectl token makes one"});
    }
  }
  Session& session = p_.sessions[connection_];
  if (holder) {
    session.role = holder->role;
    p_.server.admit(connection_);
  }
  session.user = hello.user.empty() && holder ? holder->name : hello.user;
  session.resume = hello.resume.empty() ? random_key() : hello.resume;
  session.client = hello.client;
  proto::HelloResult result;
  result.daemon = kDaemon;
  result.session = session.id;
  result.resume = session.resume;
  result.boot = p_.boot;
  result.role = session.role;
  result.features = {"springs", "reach_tree", "solve",   "objects",     "undo",
                     "holds",   "durable",    "cameras", "calibrations"};
  result.t_ns = p_.clock.now();
  result.utc_ns = utc_now();
  responder.result(result);
}

void Requests::on(const proto::SessionPing&, Responder responder) {
  responder.result(proto::PingResult{receive_t_ns_, p_.clock.now()});
}

void Requests::on(const proto::SessionStatus&, Responder responder) {
  proto::StatusResult result;
  result.daemon = kDaemon;
  result.t_ns = p_.clock.now();
  result.revision = p_.scene.revision();
  result.method = name_of(p_.solving.method);
  result.connections = static_cast<int>(p_.sessions.size());
  for (const auto& [id, figure] : p_.scene.figures()) result.figures.push_back(id);
  result.goals = static_cast<int>(p_.scene.goals().size());
  result.bindings = static_cast<int>(p_.scene.bindings().size());
  result.trackers = static_cast<int>(p_.trackers.size());
  result.frames = p_.frames;
  result.solves = p_.solving.solves();
  result.last_solve_us = 1e-3 * static_cast<double>(p_.solving.last_solve_ns());
  responder.result(result);
}

void Requests::on(const proto::SessionList&, Responder responder) {
  proto::SessionListResult result;
  for (const auto& [connection, session] : p_.sessions) {
    result.sessions.push_back({session.id, session.peer.address, session.peer.websocket ? "websocket" : "lines",
                               session.user, session.client});
  }
  responder.result(result);
}

void Requests::on(const proto::StreamSubscribe& wish, Responder responder) {
  if (const Status checked = p_.publisher.check(wish); !checked) return responder.params_error(checked.error());
  // The connection may be gone by now: then nobody would ever unsubscribe.
  const auto session = p_.sessions.find(connection_);
  if (session == p_.sessions.end()) return responder.result(proto::SubscribeResult{wish.stream});
  if (wish.encoding == proto::Encoding::cbor && !session->second.peer.websocket) {
    return responder.params_error({"encoding_needs_websocket", "CBOR has no lines: it goes over a WebSocket only",
                                   "/encoding", "connect to /ws, or leave encoding out"});
  }
  responder.result(proto::SubscribeResult{wish.stream});
  p_.publisher.subscribe(connection_, wish);
}

void Requests::on(const proto::StreamUnsubscribe& wish, Responder responder) {
  p_.publisher.unsubscribe(connection_, wish.stream);
  responder.result(proto::SubscribeResult{wish.stream});
}

// The credit was booked where the line came in.
void Requests::on(const proto::StreamAck& ack, Responder responder) {
  if (!p_.publisher.follows(connection_, ack.stream)) {
    return responder.params_error(
        {"unknown_stream", "this connection is not subscribed to " + std::string(proto::stream_name(ack.stream)),
         "/stream", "call stream.subscribe first"});
  }
  responder.result(proto::EmptyResult{});
}

}  // namespace posed
