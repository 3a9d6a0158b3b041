// What all edits have in common, and the edits of the history.
#include "server/daemon/requests.h"

namespace posed {
namespace {

proto::StepResult message(const Done& done, Revision revision) {
  return {done.step, revision, done.entities};
}

}  // namespace

EditBy Requests::by() const {
  EditBy by;
  const auto session = p_.sessions.find(connection_);
  if (session != p_.sessions.end()) by.editor = session->second.editor();
  by.owner = connection_;
  by.t_ns = p_.clock.now();
  by.method = method_;
  by.label = label_;
  by.gesture = gesture_;
  by.force = force_;
  return by;
}

// A retry of an edit that has been done gets the same reply, once that is on the disk.
bool Requests::repeated(Responder& responder) {
  if (once_.empty()) return false;
  const OnceMemory::Remembered* before = p_.once.find(once_);
  if (!before) return false;
  if (before->method != method_) {
    responder.error({"invalid_params", "this UUID is of another edit, " + before->method, "/params/once",
                     "make a new one for each edit; say the same again only to send the same edit again"});
    return true;
  }
  p_.journal.when_stored([responder, result = before->result](const Status& stored) mutable {
    if (!stored) return responder.error(stored.error());
    responder.deliver(responder.reply_text(result));
  });
  return true;
}

void Requests::done(Responder responder, std::string result, bool back) {
  std::optional<Done> done = p_.editing.take_done();
  // Where nothing has changed there is nothing to wait for, either.
  if (!done) return responder.deliver(responder.reply_text(result));
  if (!once_.empty()) p_.once.add({once_, method_, result});
  p_.edited(connection_, std::move(*done), once_, back,
            [responder, result = std::move(result)](const Status& stored) mutable {
              if (!stored) return responder.error(stored.error());
              responder.deliver(responder.reply_text(result));
            });
}

void Requests::on(const proto::EditUndo& m, Responder responder) {
  if (repeated(responder)) return;
  const Result<Done> undone = p_.editing.undo(by(), m.step);
  if (!undone) return responder.params_error(undone.error());
  done(std::move(responder), proto::encode_result(message(*undone, p_.scene.revision())), true);
}

void Requests::on(const proto::EditRedo&, Responder responder) {
  if (repeated(responder)) return;
  const Result<Done> redone = p_.editing.redo(by());
  if (!redone) return responder.params_error(redone.error());
  done(std::move(responder), proto::encode_result(message(*redone, p_.scene.revision())), true);
}

void Requests::on(const proto::EditHistory& m, Responder responder) {
  const std::string identity = by().editor.identity;
  proto::HistoryResult result;
  const auto& steps = p_.editing.history().steps();
  for (auto step = steps.rbegin(); step != steps.rend() && static_cast<int>(result.steps.size()) < m.limit; ++step) {
    result.steps.push_back({step->number, step->revision, step->t_ns, step->by.name, step->by.session, step->method,
                            step->label, step->gesture, step->change.entities(), step->by.identity == identity,
                            step->undone});
  }
  responder.result(result);
}

void Requests::on(const proto::GoalGrab& m, Responder responder) {
  EditBy who = by();
  who.force = m.force;
  if (const Status grabbed = p_.editing.grab(who, m.id); !grabbed) return responder.params_error(grabbed.error());
  responder.result(proto::GrabResult{m.id, static_cast<int>(Holds::kIdle / 1'000'000)});
}

void Requests::on(const proto::GoalRelease& m, Responder responder) {
  EditBy who = by();
  who.force = m.force;
  if (const Status released = p_.editing.release(who, m.id); !released) return responder.params_error(released.error());
  responder.result(proto::EmptyResult{});
}

}  // namespace posed
