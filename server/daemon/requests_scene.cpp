// Whole scenes: templates, and what the store keeps.
#include "common/names.h"
#include "server/daemon/requests.h"

namespace posed {

void Requests::load(std::string_view text, Responder responder) {
  const Result<SceneDocument> document = proto::decode_scene(text);
  if (!document) return responder.error(document.error());
  edit(std::move(responder), [&](Scene& scene) -> Result<proto::RevisionResult> {
    if (const Status loaded = scene.load(*document); !loaded) return loaded.error();
    return proto::RevisionResult{scene.revision()};
  });
}

void Requests::on(const proto::SceneGet&, Responder responder) {
  responder.result(proto::SceneResult{p_.scene.revision(), p_.scene.document()});
}

void Requests::on(const proto::SceneNew& m, Responder responder) {
  const Result<std::string> text = p_.templates.read(m.template_name);
  if (!text) return responder.params_error(text.error());
  label_ = m.template_name;
  load(*text, std::move(responder));
}

void Requests::on(const proto::SceneList&, Responder responder) {
  // The store answers on its own thread; what follows belongs to the station's.
  p_.store.list([&p = p_, responder](Result<std::vector<std::string>> saved) {
    p.loop.post([&p, responder, saved = std::move(saved)]() mutable {
      if (!saved) return responder.error(saved.error());
      responder.result(proto::SceneListResult{std::move(*saved), p.templates.names()});
    });
  });
}

void Requests::on(const proto::SceneSave& m, Responder responder) {
  if (!valid_id(m.name))
    return responder.error(
        {"bad_id", "the name is no id", "/params/name", "letters, digits, '_', '.' and '-', at most 64"});
  const Revision revision = p_.scene.revision();
  p_.store.save(m.name, proto::encode_scene(p_.scene.document()), [&p = p_, responder, revision](Status saved) {
    p.loop.post([responder, revision, saved]() mutable {
      if (!saved) return responder.params_error(saved.error());
      responder.result(proto::RevisionResult{revision});
    });
  });
}

void Requests::on(const proto::SceneOpen& m, Responder responder) {
  label_ = m.name;
  p_.store.load(m.name, [self = *this, responder](Result<std::string> text) {
    self.p_.loop.post([self, responder, text = std::move(text)]() mutable {
      if (!text) return responder.params_error(text.error());
      self.load(*text, std::move(responder));
    });
  });
}

void Requests::on(const proto::SceneRemove& m, Responder responder) {
  p_.store.remove(m.name, [&p = p_, responder](Status removed) {
    p.loop.post([responder, removed]() mutable {
      if (!removed) return responder.params_error(removed.error());
      responder.result(proto::EmptyResult{});
    });
  });
}

}  // namespace posed
