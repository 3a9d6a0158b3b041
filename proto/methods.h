// Private to the codec: the methods by name.
#pragma once

#include <string_view>

#include "proto/write.h"

namespace posed::proto {

// What edits accept besides their own fields.
enum class Edits {
  nothing,  // it is no edit
  entity,   // if_revision, gesture, once, force
  whole,    // of more than one entity: gesture, once, force
  step,     // of the history: once, force
};

struct Method {
  const char* name;
  Edits edits;
  Params (*read)(ReadContext& context, const Json& params);
  std::size_t index;  // in Params
};

const Method* find_method(std::string_view name);
// The parameters of a request. What every method, or every edit, accepts is read here, so that no message repeats it.
void read_request(ReadContext& context, Json params, const Method& method, Request& out);
const Method& method_of(const Params& params);
// "did you mean …?"
std::string nearest_method(std::string_view name);
// Methods of the protocol that are not served yet.
bool reserved_method(std::string_view name);

}  // namespace posed::proto
