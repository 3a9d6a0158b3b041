#include <iostream>
#include <iterator>

#include "client/cli/output.h"

namespace posed::cli {

int run_call(const Session& session, const std::string& method, const std::string& params) {
  std::string text = params;
  if (params == "-") text.assign(std::istreambuf_iterator<char>(std::cin), {});
  const auto result = session.client.call(method, text);
  if (!result) return fail(result.error());
  print_line(session.json ? *result : proto::pretty(*result));
  return kDone;
}

}  // namespace posed::cli
