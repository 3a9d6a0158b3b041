// JSON text to a tree, built by hand: the library's own way to keep keys in order compares each with all before it,
// and a line of a million bytes holds a hundred thousand keys.
#include <algorithm>

#include "proto/messages.h"
#include "proto/read.h"

namespace posed::proto {
namespace {

Error not_json(std::string message) {
  return {"parse_error", std::move(message), "", "one JSON object a line, in UTF-8"};
}

class TreeBuilder {
 public:
  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(Json::number_integer_t value) { return add(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return add(value); }
  bool number_float(Json::number_float_t value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    key_ = std::move(name);
    return true;
  }
  bool end_object() {
    if (const std::string* name = repeated(open_.back()->get_ref<const Json::object_t&>())) {
      return fail(
          {"parse_error", "the key \"" + name->substr(0, 64) + "\" stands twice in one object", "", "say it once"});
    }
    return close();
  }
  bool parse_error(std::size_t position, const std::string& token, const Json::exception& reason) {
    constexpr int kNumberOverflow = 406;
    if (reason.id == kNumberOverflow) return fail(not_json("the number " + token.substr(0, 64) + " is too large"));
    return fail(not_json("the line is not JSON: see byte " + std::to_string(position)));
  }

  Json take() { return std::move(root_); }
  const std::optional<Error>& error() const { return error_; }

 private:
  // Where the next value goes. Pointers to what is open stay good: nothing around it grows before it is closed.
  template <class T>
  bool add(T&& value) {
    place(std::forward<T>(value));
    return true;
  }

  template <class T>
  Json* place(T&& value) {
    if (open_.empty()) return &(root_ = std::forward<T>(value));
    if (open_.back()->is_array()) return &open_.back()->emplace_back(std::forward<T>(value));
    auto& members = open_.back()->get_ref<Json::object_t&>();
    return &members.emplace_back(std::move(key_), std::forward<T>(value)).second;
  }

  bool open(Json value) {
    if (open_.size() == kMaxDepth) return fail({"parse_error", "the text nests deeper than 64", "", "flatten it"});
    open_.push_back(place(std::move(value)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  bool fail(Error error) {
    error_ = std::move(error);
    return false;
  }

  const std::string* repeated(const Json::object_t& members) {
    keys_.clear();
    for (const auto& [name, value] : members) keys_.push_back(&name);
    std::sort(keys_.begin(), keys_.end(), [](const auto* a, const auto* b) { return *a < *b; });
    const auto twice =
        std::adjacent_find(keys_.begin(), keys_.end(), [](const auto* a, const auto* b) { return *a == *b; });
    return twice == keys_.end() ? nullptr : *twice;
  }

  Json root_;
  std::vector<Json*> open_;
  std::string key_;
  std::vector<const std::string*> keys_;
  std::optional<Error> error_;
};

}  // namespace

Result<Json> parse(std::string_view text) {
  TreeBuilder builder;
  const bool good = Json::sax_parse(text, &builder);
  if (builder.error()) return *builder.error();
  if (!good) return not_json("the line is not JSON");
  return builder.take();
}

}  // namespace posed::proto
