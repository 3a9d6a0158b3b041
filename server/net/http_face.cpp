#include "server/net/http_face.h"

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>

#include "server/net/websocket_face.h"

namespace posed::net {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;

constexpr std::size_t kMaxHeader = 16 << 10;

std::string text(const boost::beast::string_view& view) {
  return std::string(view.data(), view.size());
}

// A header that may come in several lines is one list.
std::string list(const http::request<http::empty_body>& message, http::field name) {
  std::string all;
  const auto lines = message.equal_range(name);
  for (auto it = lines.first; it != lines.second; ++it) all += (all.empty() ? "" : ",") + text(it->value());
  return all;
}

HttpRequest request_of(const http::request<http::empty_body>& message) {
  HttpRequest request;
  request.method = text(message.method_string());
  request.target = text(message.target());
  request.host = text(message[http::field::host]);
  request.origin = text(message[http::field::origin]);
  request.if_none_match = text(message[http::field::if_none_match]);
  request.authorization = text(message[http::field::authorization]);
  request.upgrade = text(message[http::field::upgrade]);
  request.connection = list(message, http::field::connection);
  request.accept_encoding = list(message, http::field::accept_encoding);
  request.websocket_key = text(message[http::field::sec_websocket_key]);
  request.websocket_version = text(message[http::field::sec_websocket_version]);
  return request;
}

}  // namespace

HttpFace::HttpFace(Link& link, HttpSite& site, const Limits& limits, Tally& tally)
    : link_(link), site_(site), limits_(limits), tally_(tally) {}

void HttpFace::take(std::string_view bytes) {
  if (over_) return;
  buffer_.append(bytes);
  for (;;) {
    // One reply at a time: pipelined requests do not pile up files in memory.
    stuck_ = !buffer_.empty() && !link_.idle();
    if (stuck_) return;
    if (!buffer_.empty() && !asked_) {
      asked_ = true;
      link_.deadline(limits_.http_request);
    }
    if (buffer_.empty() || !take_one()) return;
  }
}

bool HttpFace::take_one() {
  const std::size_t end = buffer_.find("\r\n\r\n");
  if (end == std::string::npos ? buffer_.size() > kMaxHeader : end > kMaxHeader) {
    return answer(plain_reply(431, "the request's header is too long"), false, true), false;
  }
  if (end == std::string::npos) return false;

  http::request_parser<http::empty_body> parser;
  boost::system::error_code error;
  const std::size_t used = parser.put(asio::buffer(buffer_.data(), end + 4), error);
  const bool reads = parser.is_header_done() &&
                     (parser.get().method() == http::verb::get || parser.get().method() == http::verb::head);
  // Other methods may bring a body, which is not waited for: they are refused by their header.
  if (!parser.is_header_done() || (reads && !parser.is_done())) {
    return answer(plain_reply(400, "this is no HTTP request that we know"), false, true), false;
  }

  buffer_.erase(0, used);
  asked_ = false;
  add(tally_.http_requests);
  if (!link_.may_ask()) {
    return answer(plain_reply(429, "too many requests of this address; try again in a second", "Retry-After: 1\r\n"),
                  false, true),
           false;
  }
  const HttpRequest request = request_of(parser.get());
  const HttpReply reply = site_.answer(request);
  if (reply.status == 101) {
    over_ = true;
    link_.send(std::make_shared<const std::string>(encode_http_header(reply, true)));
    link_.deadline(0);
    link_.open(true);
    const std::string rest = std::move(buffer_);
    link_.become(std::make_unique<WebsocketFace>(link_, limits_.line_bytes), rest);
    return false;
  }
  const bool keep_alive = reads && parser.get().keep_alive();
  answer(reply, keep_alive, request.method != "HEAD");
  return keep_alive;
}

void HttpFace::answer(const HttpReply& reply, bool keep_alive, bool with_body) {
  link_.deadline(limits_.http_reply);
  link_.send(std::make_shared<const std::string>(encode_http_header(reply, keep_alive)));
  if (with_body && reply.body && !reply.body->empty()) link_.send(reply.body);
  if (keep_alive) return;
  over_ = true;
  buffer_.clear();
  link_.part(0, std::nullopt, Link::Owed::forget);
}

}  // namespace posed::net
