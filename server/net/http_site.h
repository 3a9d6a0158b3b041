// What the HTTP side answers. Requests and replies as values; parsing and sending are elsewhere.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "server/net/host_policy.h"
#include "server/net/http_files.h"
#include "server/net/subscription.h"
#include "server/net/tokens.h"

namespace posed::net {

struct HttpRequest {
  std::string method, target, host, origin, if_none_match, accept_encoding, authorization;
  std::string upgrade, connection, websocket_key, websocket_version;
};

struct HttpReply {
  int status = 200;
  std::string content_type;
  std::string headers;  // further ones, each ended by "\r\n"
  SharedLine body;      // may be null
};

class HttpSite {
 public:
  HttpSite(HostPolicy policy, std::filesystem::path viewer, std::shared_ptr<const Tokens> tokens = nullptr)
      : policy_(std::move(policy)), files_(std::move(viewer)), tokens_(std::move(tokens)) {}

  void set_page(std::string path, std::string content_type, SharedLine body);
  // A reply of status 101 means: go on as a WebSocket.
  HttpReply answer(const HttpRequest& request);

 private:
  struct Page {
    std::string content_type;
    SharedLine body;
  };

  HttpReply upgrade(const HttpRequest& request) const;
  static HttpReply file_reply(const HttpFiles::File& file, const HttpRequest& request);
  bool may_read_pages(const HttpRequest& request) const;

  HostPolicy policy_;
  HttpFiles files_;
  std::shared_ptr<const Tokens> tokens_;
  std::map<std::string, Page, std::less<>> pages_;
};

HttpReply plain_reply(int status, std::string text, std::string headers = "");

// Status line and headers, to the blank line.
std::string encode_http_header(const HttpReply& reply, bool keep_alive);

}  // namespace posed::net
