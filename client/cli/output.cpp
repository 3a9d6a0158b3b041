#include "client/cli/output.h"

namespace posed::cli {

int fail(const Error& error) {
  std::string text = "posectl: " + error.message;
  if (!error.path.empty()) text += " (at " + error.path + ')';
  if (!error.hint.empty()) text += "\nposectl: " + error.hint;
  std::fprintf(stderr, "%s\n", text.c_str());
  if (error.code == "bad_address") return kUsage;
  const bool no_daemon = error.code == "cannot_connect" || error.code == "connection_lost" || error.code == "timeout" ||
                         error.code == "bad_reply";
  return no_daemon ? kNoDaemon : kRefused;
}

void print_line(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fputc('\n', stdout);
  std::fflush(stdout);
}

int edit(const Session& session, const proto::Params& params, const std::string& done) {
  return request<proto::RevisionResult>(session, params, [&](const proto::RevisionResult& result) {
    print_line(format("%s (revision %llu)", done.c_str(), static_cast<unsigned long long>(result.revision)));
  });
}

}  // namespace posed::cli
