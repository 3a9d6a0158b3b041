// Short ways to decode one line and look at what came of it.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "proto/codec.h"
#include "proto/methods.h"

namespace posed::proto {

using nlohmann::json;

inline std::string call(const std::string& method, const std::string& params) {
  return R"({"jsonrpc":"2.0","id":1,"method":")" + method + R"(","params":)" + params + "}";
}

// The one entry of a line that is no batch.
inline std::variant<Request, BadRequest> only_entry(const std::string& text) {
  Line line = decode_line(text);
  EXPECT_FALSE(line.batch);
  EXPECT_EQ(line.entries.size(), 1u);
  return line.entries.at(0);
}

inline Request accepted(const std::string& text) {
  const auto entry = only_entry(text);
  if (const auto* bad = std::get_if<BadRequest>(&entry)) {
    ADD_FAILURE() << text.substr(0, 200) << ": " << bad->error.code << " " << bad->error.path << " "
                  << bad->error.message;
    return {};
  }
  return std::get<Request>(entry);
}

inline BadRequest refused(const std::string& text) {
  const auto entry = only_entry(text);
  if (const auto* bad = std::get_if<BadRequest>(&entry)) {
    EXPECT_FALSE(bad->error.message.empty());
    return *bad;
  }
  ADD_FAILURE() << "accepted: " << text.substr(0, 200);
  return {};
}

inline void expect_error(const std::string& text, const std::string& code, const std::string& path) {
  const BadRequest bad = refused(text);
  EXPECT_EQ(bad.error.code, code) << text.substr(0, 200) << "\n" << bad.error.message;
  EXPECT_EQ(bad.error.path, path) << text.substr(0, 200);
}

template <class Message>
Message params_of(const std::string& method, const std::string& params) {
  const Request request = accepted(call(method, params));
  const Message* message = std::get_if<Message>(&request.params);
  EXPECT_NE(message, nullptr) << method;
  return message ? *message : Message{};
}

// One default message of every method.
template <std::size_t... I>
std::vector<Params> every_message(std::index_sequence<I...>) {
  return {Params(std::in_place_index<I>)...};
}
inline std::vector<Params> every_message() {
  return every_message(std::make_index_sequence<std::variant_size_v<Params>>());
}

}  // namespace posed::proto
