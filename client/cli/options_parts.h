// The parts of posectl's command line, a family each. Only the command line itself includes this.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "client/cli/commands.h"
#include "client/cli/options.h"

namespace posed::cli {

// A subcommand's callback only notes what to do; it is done when the daemon is there.
using Run = std::function<int(const Session&)>;

void add_status(CLI::App& app, Run& run);  // and session
void add_watch(CLI::App& app, Run& run);
void add_view(CLI::App& app, Run& run);
void add_tracker(CLI::App& app, Run& run);
void add_solve(CLI::App& app, Run& run);
void add_camera(CLI::App& app, Run& run);
void add_call(CLI::App& app, Run& run);

void add_goal(CLI::App& app, Run& run);

void add_figure(CLI::App& app, Run& run);
void add_joint(CLI::App& app, Run& run);
void add_pose(CLI::App& app, Run& run);
void add_object(CLI::App& app, Run& run);
void add_binding(CLI::App& app, Run& run);

void add_scene(CLI::App& app, Run& run);
void add_edit(CLI::App& app, Run& run);  // and undo, redo, history

void add_doctor(CLI::App& app, Options& options);
void add_token(CLI::App& app, std::function<int()>& run);
void add_completion(CLI::App& app, std::function<int()>& run);

// Every command has one, and a test runs it.
inline CLI::App* example(CLI::App* command, const std::string& line) {
  command->footer("Example:\n  " + line);
  return command;
}

// X list, X get ID and X remove ID, which are the same for every entity.
void add_entity(CLI::App* family, Run& run, const std::string& noun, const std::string& id, int (*list)(const Session&),
                int (*get)(const Session&, const std::string&), int (*remove)(const Session&, const std::string&));

// `word` up to the first slash is the segment, what follows the site.
Attachment attachment_from(const std::string& word);
inline Vec3 vector_from(const std::vector<double>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace posed::cli
