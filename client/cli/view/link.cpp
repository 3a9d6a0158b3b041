#include "client/cli/view/link.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include "client/lib/clock.h"

namespace posed::view {
namespace {

using client::steady_now;
using std::chrono::milliseconds;

constexpr milliseconds kPatience{500};  // with a daemon that is gone, before that is said and tried again
constexpr milliseconds kTick{250};
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kBetweenAsks = kSecond / 20;  // while others edit without a pause
constexpr int kCredit = 3;                           // who stalls wakes to what is

}  // namespace

Result<std::shared_ptr<const Entities>> Link::ask(client::Client& client, const Entities& before) {
  auto entities = std::make_shared<Entities>();
  auto figures = client.call<proto::FigureListResult>(proto::FigureList{});
  if (!figures) return figures.error();
  for (const proto::FigureSummary& summary : figures->figures) {
    const auto known = before.figures.find(summary.id);
    if (known != before.figures.end() && known->second.entity_revision == summary.entity_revision) {
      entities->figures.insert(*known);
      continue;
    }
    auto figure = client.call<proto::FigureResult>(proto::FigureGet{summary.id});
    if (figure)
      entities->figures.emplace(summary.id, std::move(*figure));
    else if (figure.error().code != "unknown_figure")  // removed this very moment
      return figure.error();
  }
  auto goals = client.call<proto::GoalListResult>(proto::GoalList{});
  if (!goals) return goals.error();
  entities->goals = std::move(goals->goals);
  const auto objects = client.call<proto::ObjectListResult>(proto::ObjectList{});
  if (!objects) return objects.error();
  for (const proto::ObjectResult& o : objects->objects) entities->objects.push_back(o.object);
  const auto bindings = client.call<proto::BindingListResult>(proto::BindingList{});
  if (!bindings) return bindings.error();
  for (const proto::BindingResult& b : bindings->bindings) entities->bindings.push_back(b.binding);
  return std::shared_ptr<const Entities>(std::move(entities));
}

Link::Link(client::Client& client, std::string figure, double max_rate_hz)
    : client_(client),
      figure_(std::move(figure)),
      max_rate_hz_(max_rate_hz),
      changed_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      thread_([this] { run(); }) {}

Link::~Link() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  client_.wake();
  thread_.join();
  ::close(changed_);
}

void Link::heard() const {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto got = ::read(changed_, &count, sizeof count);
}

Station Link::station() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}

std::uint64_t Link::send(Edit edit) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++sent_;
    // Only the last one may be replaced: edits keep their order.
    if (!edit.key.empty() && !edits_.empty() && edits_.back().edit.key == edit.key)
      edits_.back() = {std::move(edit), number};
    else
      edits_.push_back({std::move(edit), number});
  }
  client_.wake();
  return number;
}

void Link::tell(const Station& now) {
  {
    const std::lock_guard lock(mutex_);
    shown_ = now;
  }
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto sent = ::write(changed_, &one, sizeof one);
}

void Link::note(std::string text, bool bad) {
  ++now_.notes;
  now_.note = {std::move(text), bad};
}

Status Link::subscribe_to(proto::Stream stream) {
  proto::StreamSubscribe wish;
  wish.stream = stream;
  wish.max_rate_hz = max_rate_hz_;
  wish.credit = kCredit;
  return client_.subscribe(wish);
}

Status Link::subscribe() {
  proto::StreamSubscribe pose;
  pose.fields = {"world_from_segment", "goals", "objects"};
  pose.max_rate_hz = max_rate_hz_;
  pose.credit = kCredit;
  if (!figure_.empty()) pose.figures = {figure_};
  if (Status done = client_.subscribe(pose); !done) return done;
  for (const auto stream : {proto::Stream::tracker, proto::Stream::camera}) {
    if (Status done = subscribe_to(stream); !done) return done;
  }
  // The scene's stream is the bell that tells when to ask for its entities.
  proto::StreamSubscribe scene;
  scene.stream = proto::Stream::scene;
  return client_.subscribe(scene);
}

void Link::do_edits() {
  for (;;) {
    Numbered next;
    {
      const std::lock_guard lock(mutex_);
      if (edits_.empty()) return;
      next = std::move(edits_.front());
      edits_.pop_front();
    }
    const auto done = client_.call(next.edit.method, next.edit.params);
    if (!done)
      note("not done: " + done.error().message + (done.error().hint.empty() ? "" : "; " + done.error().hint), true);
    else if (next.edit.method == "edit.undo")
      note("undone", false);
    else if (next.edit.method == "edit.redo")
      note("done again", false);
    now_.edits_done = next.number;
    stale_ = true;
    asked_t_ns_ = 0;
  }
}

void Link::take(const proto::Incoming& frame) {
  if (frame.stream == proto::Stream::scene) {
    stale_ = true;
    return;
  }
  if (frame.stream == proto::Stream::tracker) {
    const auto data = proto::decode_message<proto::TrackerData>(frame.data);
    if (!data) return note(data.error().message, true);
    for (const proto::SensorData& s : data->sensors) now_.sensors[s.sensor] = {s.position, s.rotation};
    return;
  }
  if (frame.stream == proto::Stream::camera) {
    auto data = proto::decode_message<proto::CameraData>(frame.data);
    if (!data) return note(data.error().message, true);
    now_.cameras = std::move(data->cameras);
    return;
  }
  auto pose = proto::decode_message<proto::PoseData>(frame.data);
  if (!pose) return note(pose.error().message, true);
  const std::int64_t t = steady_now();
  // The first frame is of whenever the pose last changed: its age says nothing.
  if (!std::exchange(first_frame_, false)) {
    arrivals_.push_back(t);
    if (clock_offset_) now_.age_ms = 1e-6 * static_cast<double>(t + *clock_offset_ - pose->t_ns);
  }
  now_.pose = std::make_shared<const proto::PoseData>(std::move(*pose));
}

Status Link::follow() {
  if (!subscribed_) {
    if (Status done = subscribe(); !done) return done;
    subscribed_ = true;
    clock_offset_ = client::clock_offset(client_);
  }
  do_edits();
  if (stale_ && steady_now() - asked_t_ns_ >= kBetweenAsks) {
    auto entities = ask(client_, *now_.entities);
    if (!entities) return entities.error();
    now_.entities = std::move(*entities);
    stale_ = false;
    asked_t_ns_ = steady_now();
    tell(now_);
  }
  const auto frame = client_.next(stale_ ? milliseconds(kBetweenAsks / 1'000'000) : kTick);
  if (frame)
    take(*frame);
  else if (frame.error().code != "timeout" && frame.error().code != "woken")
    return frame.error();
  if (std::exchange(reconnected_, client_.reconnected()) != client_.reconnected()) {
    // It may be another daemon: nothing that we know need hold.
    stale_ = first_frame_ = true;
    now_.entities = std::make_shared<Entities>();
    now_.sensors.clear();
    now_.cameras.clear();
    clock_offset_ = client::clock_offset(client_);
    note("the connection was lost, and is there again", false);
  }
  return Ok{};
}

void Link::run() {
  client_.keep_connected(kPatience);
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      if (ended_) return;
    }
    const Status followed = follow();
    const std::string why = followed ? "" : followed.error().message;
    // What an edit was refused for is a note; here only the connection can be wrong.
    if (!followed && followed.error().code != "connection_lost" && followed.error().code != "cannot_connect")
      std::this_thread::sleep_for(kPatience);
    const std::int64_t now = steady_now();
    while (!arrivals_.empty() && arrivals_.front() < now - kSecond) arrivals_.pop_front();
    now_.lost_why = why;
    now_.rate_hz = static_cast<double>(arrivals_.size());
    if (arrivals_.empty()) now_.age_ms.reset();
    now_.lost = client_.lost(proto::Stream::pose);
    tell(now_);
  }
}

}  // namespace posed::view
