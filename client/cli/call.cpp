#include "client/cli/output.h"

namespace posed::cli {

int run_call(const Session& session, const std::string& method, const std::string& params) {
  const auto text = params == "-" ? read_file(params) : params;
  if (!text) return fail(text.error());
  const auto result = session.client.call(method, *text);
  if (!result) return fail(result.error());
  print_line(session.json ? *result : proto::pretty(*result));
  return kDone;
}

}  // namespace posed::cli
