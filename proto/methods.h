// Private to the codec: the methods by name.
#pragma once

#include <string_view>

#include "proto/write.h"

namespace posed::proto {

struct Method {
  const char* name;
  bool edits;  // takes if_revision
  Params (*read)(ReadContext& context, const Json& params);
  std::size_t index;  // in Params
};

const Method* find_method(std::string_view name);
const Method& method_of(const Params& params);
// "did you mean …?"
std::string nearest_method(std::string_view name);
// Methods of the protocol that are not served yet.
bool reserved_method(std::string_view name);

}  // namespace posed::proto
