#include "server/net/accept_encoding.h"

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <charconv>
#include <optional>
#include <string>

namespace posed::net {
namespace {

namespace beast = boost::beast;

// A weight that is none counts as a refusal.
double weight_of(const beast::string_view& text) {
  double weight = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), weight);
  const bool sound = error == std::errc() && end == text.data() + text.size() && weight >= 0 && weight <= 1;
  return sound ? weight : 0;
}

}  // namespace

bool prefers_gzip(std::string_view accept_encoding) {
  std::optional<double> gzip, identity, others;
  // Up to Boost 1.74 an element that ends the text without parameters keeps those of the one before.
  const std::string text = std::string(accept_encoding) + ',';
  for (const auto& [coding, parameters] : beast::http::ext_list(text)) {
    double weight = 1;
    for (const auto& [name, value] : parameters) {
      if (beast::iequals(name, "q")) weight = weight_of(value);
    }
    if (beast::iequals(coding, "gzip") || beast::iequals(coding, "x-gzip")) gzip = weight;
    if (beast::iequals(coding, "identity")) identity = weight;
    if (coding == "*") others = weight;
  }
  const double packed = gzip.value_or(others.value_or(0));
  // Plain bytes that nobody speaks of are the last resort.
  return packed > 0 && packed >= identity.value_or(0);
}

}  // namespace posed::net
