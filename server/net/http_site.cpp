#include "server/net/http_site.h"

#include <algorithm>

#include "server/net/accept_encoding.h"
#include "server/net/websocket_frames.h"

namespace posed::net {
namespace {

constexpr std::string_view kNoViewer =
    "<!doctype html><meta charset=\"utf-8\"><title>posed</title>\n"
    "<h1>posed is running</h1>\n"
    "<p>Its viewer was not built. <code>./deploy/build</code> builds it; then load this page again.</p>\n"
    "<p>Everything else works: the protocol on this port, <a href=\"/healthz\">/healthz</a>, "
    "<a href=\"/metrics\">/metrics</a>.</p>\n";

// Scripts and connections from here only; the viewer styles its elements, and makes images of its own.
constexpr std::string_view kSecurity =
    "Content-Security-Policy: default-src 'self'; style-src 'self' 'unsafe-inline'; connect-src 'self'; "
    "img-src 'self' data: blob:; object-src 'none'; frame-ancestors 'self'; base-uri 'none'; form-action 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Referrer-Policy: no-referrer\r\n";

std::string_view reason(int status) {
  switch (status) {
    case 101:
      return "Switching Protocols";
    case 200:
      return "OK";
    case 304:
      return "Not Modified";
    case 400:
      return "Bad Request";
    case 401:
      return "Unauthorized";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 421:
      return "Misdirected Request";
    case 426:
      return "Upgrade Required";
    case 429:
      return "Too Many Requests";
    case 431:
      return "Request Header Fields Too Large";
    default:
      return "Error";
  }
}

bool equal_nocase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return (x | 0x20) == (y | 0x20); });
}

// Of a header that lists tokens between commas.
bool has_token(std::string_view list, std::string_view token) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    std::string_view here = list.substr(0, end);
    while (here.starts_with(' ') || here.starts_with('\t')) here.remove_prefix(1);
    while (here.ends_with(' ') || here.ends_with('\t')) here.remove_suffix(1);
    if (equal_nocase(here, token)) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

}  // namespace

HttpReply plain_reply(int status, std::string text, std::string headers) {
  return {status, "text/plain; charset=utf-8", std::move(headers),
          std::make_shared<const std::string>(text.append("\n"))};
}

std::string encode_http_header(const HttpReply& reply, bool keep_alive) {
  std::string text = "HTTP/1.1 " + std::to_string(reply.status) + ' ';
  text.append(reason(reply.status)).append("\r\n");
  if (reply.status != 101) {
    text.append(kSecurity).append(keep_alive ? "Connection: keep-alive\r\n" : "Connection: close\r\n");
    if (reply.status != 304) {
      text.append("Content-Type: ").append(reply.content_type).append("\r\n");
      text.append("Content-Length: ").append(std::to_string(reply.body ? reply.body->size() : 0)).append("\r\n");
    }
  }
  return text.append(reply.headers).append("\r\n");
}

void HttpSite::set_page(std::string path, std::string content_type, SharedLine body) {
  pages_[std::move(path)] = {std::move(content_type), std::move(body)};
}

HttpReply HttpSite::upgrade(const HttpRequest& request) const {
  if (!equal_nocase(request.upgrade, "websocket") || !has_token(request.connection, "upgrade")) {
    return plain_reply(426, "/ws is a WebSocket: connect with new WebSocket(\"ws://" + request.host + "/ws\")",
                       "Upgrade: websocket\r\n");
  }
  if (request.websocket_version != "13") {
    return plain_reply(426, "only version 13 of the WebSocket protocol is spoken here",
                       "Sec-WebSocket-Version: 13\r\n");
  }
  if (request.websocket_key.size() != 24) return plain_reply(400, "Sec-WebSocket-Key must be 16 bytes in base64");
  if (!request.origin.empty() && !policy_.origin_allowed(request.origin, request.host)) {
    return plain_reply(403, "pages of " + request.origin + " may not connect to " + request.host);
  }
  HttpReply reply;
  reply.status = 101;
  reply.headers =
      "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: " + accept_key(request.websocket_key) +
      "\r\n";
  return reply;
}

bool HttpSite::may_read_pages(const HttpRequest& request) const {
  constexpr std::string_view kScheme = "Bearer ";
  const std::string_view given = request.authorization;
  return !tokens_ || (given.starts_with(kScheme) && tokens_->find(given.substr(kScheme.size())));
}

HttpReply HttpSite::file_reply(const HttpFiles::File& file, const HttpRequest& request) {
  const bool packed = file.gzip && prefers_gzip(request.accept_encoding);
  // Two representations, two tags.
  const std::string etag = '"' + file.etag + (packed ? "-gzip\"" : "\"");
  HttpReply reply{200, file.content_type, "", packed ? file.gzip : file.body};
  reply.headers = "ETag: " + etag + "\r\nCache-Control: " + file.cache_control + "\r\n";
  if (file.gzip) reply.headers += "Vary: Accept-Encoding\r\n";
  if (request.if_none_match == etag) {
    reply.status = 304;
    reply.body = nullptr;
  } else if (packed) {
    reply.headers += "Content-Encoding: gzip\r\n";
  }
  return reply;
}

HttpReply HttpSite::answer(const HttpRequest& request) {
  if (request.method != "GET" && request.method != "HEAD") {
    return plain_reply(405, "only GET and HEAD; requests go over the WebSocket at /ws or as JSON lines over TCP",
                       "Allow: GET, HEAD\r\n");
  }
  if (request.host.empty()) return plain_reply(400, "a Host header is needed");
  if (!policy_.host_allowed(request.host)) {
    return plain_reply(421, request.host +
                                " is not a name of this daemon; use its address, or start it with --listen.name " +
                                host_without_port(request.host));
  }
  const std::string_view target = request.target;
  const std::string_view path = target.substr(0, target.find_first_of("?#"));
  if (path == "/ws") return upgrade(request);
  if (path == "/healthz") return plain_reply(200, "ok", "Cache-Control: no-store\r\n");
  if (const auto page = pages_.find(path); page != pages_.end()) {
    if (!may_read_pages(request)) {
      return plain_reply(401, "this page wants a token: send the header Authorization: Bearer TOKEN",
                         "WWW-Authenticate: Bearer\r\nCache-Control: no-store\r\n");
    }
    return {200, page->second.content_type, "Cache-Control: no-store\r\n", page->second.body};
  }
  if (const auto file = files_.find(target)) return file_reply(*file, request);
  if ((path == "/" || path == "/index.html") && !files_.present()) {
    return {200, "text/html; charset=utf-8", "Cache-Control: no-store\r\n",
            std::make_shared<const std::string>(kNoViewer)};
  }
  return plain_reply(404, "there is nothing at " + std::string(path));
}

}  // namespace posed::net
