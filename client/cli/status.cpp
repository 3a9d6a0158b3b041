#include "client/cli/output.h"

namespace posed::cli {

int run_status(const Session& session) {
  return request<proto::StatusResult>(session, proto::SessionStatus{}, [](const proto::StatusResult& s) {
    std::string figures;
    for (const std::string& figure : s.figures) figures += (figures.empty() ? "" : ", ") + figure;
    print_line(format("%s %s, up %.1f s, revision %llu, %d connected", s.daemon.name.c_str(), s.daemon.version.c_str(),
                      static_cast<double>(s.t_ns) * 1e-9, static_cast<unsigned long long>(s.revision), s.connections));
    print_line(format("scene    figures: %s; %d goals, %d bindings", figures.empty() ? "none" : figures.c_str(),
                      s.goals, s.bindings));
    print_line(format("trackers %d, %llu frames", s.trackers, static_cast<unsigned long long>(s.frames)));
    print_line(format("solver   %s, %llu solves, the last in %.1f us", s.method.c_str(),
                      static_cast<unsigned long long>(s.solves), s.last_solve_us));
  });
}

int list_sessions(const Session& session) {
  return request<proto::SessionListResult>(session, proto::SessionList{}, [](const proto::SessionListResult& list) {
    for (const proto::SessionEntry& entry : list.sessions) {
      print_line(format("%-6s  %-21s  %-9s  %-12s  %s %s", entry.session.c_str(), entry.address.c_str(),
                        entry.face.c_str(), entry.user.empty() ? "-" : entry.user.c_str(), entry.client.name.c_str(),
                        entry.client.version.c_str()));
    }
  });
}

}  // namespace posed::cli
