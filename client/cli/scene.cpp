#include "client/cli/output.h"

namespace posed::cli {

int list_scenes(const Session& session) {
  return request<proto::SceneListResult>(session, proto::SceneList{}, [](const proto::SceneListResult& list) {
    for (const std::string& name : list.saved) print_line("saved     " + name);
    for (const std::string& name : list.templates) print_line("template  " + name);
  });
}

int get_scene(const Session& session) {
  const auto text = session.client.request(proto::SceneGet{});
  if (!text) return fail(text.error());
  print_line(session.json ? *text : proto::pretty(*text));
  return kDone;
}

int new_scene(const Session& session, const std::string& template_name) {
  return edit(session, proto::SceneNew{template_name}, "the scene is new, from " + template_name);
}

int save_scene(const Session& session, const std::string& name) {
  const auto text = session.client.request(proto::SceneSave{name});
  if (!text) return fail(text.error());
  print_line(session.json ? *text : "the scene is saved as " + name);
  return kDone;
}

int open_scene(const Session& session, const std::string& name) {
  return edit(session, proto::SceneOpen{name}, name + " is open");
}

}  // namespace posed::cli
