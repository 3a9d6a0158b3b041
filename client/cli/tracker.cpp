#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>

#include "client/cli/output.h"

namespace posed::cli {
namespace {

std::string show(const Calibration& c) {
  const std::time_t seconds = static_cast<std::time_t>(c.utc_ns / 1'000'000'000);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", &utc);
  std::string line = format("%s  %s  by %s", c.name.c_str(), date, c.author.c_str());
  if (!c.points.empty()) line += format("  %zu points, %.1f mm rms", c.points.size(), c.residual_m * 1e3);
  for (const auto& [station, sensor] : c.sensors) {
    if (sensor.tip && sensor.tip->samples > 0)
      line += format("  tip of :%s %.1f mm rms", station.c_str(), sensor.tip->residual_m * 1e3);
    if (sensor.tip && sensor.tip->samples == 0) line += format("  tip of :%s as given", station.c_str());
    if (sensor.boresight) line += format("  boresight of :%s", station.c_str());
  }
  return line;
}

void print_calibration(const proto::CalibrationResult& result) {
  const Calibration& c = result.calibration;
  for (const AlignedPoint& p : c.points)
    print_line(format("[%g %g %g] m  %.1f mm off", p.world.x, p.world.y, p.world.z, p.residual_m * 1e3));
  print_line(c.tracker + ": " + show(c));
}

// A measurement takes as long as it was asked to.
void be_patient(const Session& session, int for_ms) {
  session.client.set_timeout(std::chrono::milliseconds(for_ms) + std::chrono::seconds(5));
}

void say(const std::string& text) {
  std::fprintf(stderr, "%s\n", text.c_str());
}

}  // namespace

int list_trackers(const Session& session) {
  return request<proto::TrackerListResult>(session, proto::TrackerList{}, [](const proto::TrackerListResult& list) {
    if (list.trackers.empty()) print_line("no trackers");
    for (const proto::TrackerEntry& tracker : list.trackers) {
      std::string sensors;
      for (const std::string& sensor : tracker.sensors) sensors += ' ' + sensor;
      std::string line = format("%s  %s  %.0f Hz  %llu frames", tracker.tracker.c_str(), tracker.state.c_str(),
                                tracker.rate_hz, static_cast<unsigned long long>(tracker.frames));
      if (tracker.bad_bytes > 0) {
        line += format("  %llu bad bytes", static_cast<unsigned long long>(tracker.bad_bytes));
      }
      if (!sensors.empty()) line += " " + sensors;
      if (!tracker.held_by.empty()) line += "  held by " + tracker.held_by;
      if (!tracker.message.empty()) line += "  " + tracker.message;
      print_line(line);
      for (const Calibration& c : tracker.calibrations)
        print_line((c.name == tracker.calibration ? "  * " : "    ") + show(c));
    }
  });
}

// A hold is the connection's: it lasts as long as this program.
int grab_tracker(const Session& session, const proto::TrackerGrab& grab, double seconds) {
  using Steady = std::chrono::steady_clock;
  const auto until = Steady::now() + std::chrono::duration<double>(seconds);
  for (bool first = true; first || seconds <= 0.0 || Steady::now() < until; first = false) {
    const auto text = session.client.request(grab);
    if (!text) return fail(text.error());
    if (first) {
      print_line(session.json ? *text : grab.tracker + " is held until this ends (Ctrl-C)");
      std::fflush(stdout);
    }
    const auto left = seconds > 0.0
                          ? std::min<std::chrono::duration<double>>(until - Steady::now(), std::chrono::seconds(2))
                          : std::chrono::duration<double>(2.0);
    if (left.count() > 0.0) std::this_thread::sleep_for(left);
  }
  return kDone;
}

namespace {

int done(const Session& session, const proto::Params& params, const std::string& what) {
  const auto text = session.client.request(params);
  if (!text) return fail(text.error());
  print_line(session.json ? *text : what);
  return kDone;
}

}  // namespace

int release_tracker(const Session& session, const proto::TrackerRelease& release) {
  return done(session, release, release.tracker + " is nobody's");
}

int reset_tracker(const Session& session, const proto::TrackerReset& reset) {
  return done(session, reset, reset.tracker + " is as it began, without a calibration");
}

int configure_tracker(const Session& session, const proto::TrackerConfigure& configure) {
  return done(session, configure, configure.tracker + " is told");
}

// One point after the other, each when the user says so with Enter (or a line of a script).
int align_tracker(const Session& session, const Align& wish) {
  be_patient(session, wish.for_ms);
  proto::TrackerAlign align;
  align.tracker = wish.sensor.substr(0, wish.sensor.rfind(':'));
  align.name = wish.name;
  align.force = wish.force;
  const auto grabbed = session.client.request(proto::TrackerGrab{align.tracker, wish.force});
  if (!grabbed) return fail(grabbed.error());
  for (std::size_t i = 0; i < wish.points.size(); ++i) {
    const Vec3& p = wish.points[i];
    say(format("Touch [%g %g %g] with %s, hold it still, and press Enter (%zu of %zu).", p.x, p.y, p.z,
               wish.sensor.c_str(), i + 1, wish.points.size()));
    for (int c = std::getchar(); c != '\n'; c = std::getchar()) {
      if (c == EOF)
        return fail({"bad_usage", format("the input ended at point %zu of %zu", i + 1, wish.points.size()), "",
                     "give a line for each point"});
    }
    const auto text = session.client.request(proto::TrackerTouch{wish.sensor, wish.force, wish.for_ms, {}});
    if (!text) return fail(text.error());
    const auto touch = proto::decode_message<proto::TouchResult>(*text);
    if (!touch) return fail(touch.error());
    say(format("  %d samples, spread %.1f mm", touch->samples, touch->spread_m * 1e3));
    align.points.push_back({touch->source, p, 0.0});
  }
  return request<proto::CalibrationResult>(session, align, print_calibration);
}

int calibrate_tip(const Session& session, const proto::TrackerTip& tip) {
  be_patient(session, tip.for_ms);
  if (!tip.offset)
    say(format("Hold the tip of %s in one place and swing the other end in wide circles for %g s.", tip.sensor.c_str(),
               tip.for_ms * 1e-3));
  return request<proto::CalibrationResult>(session, tip, print_calibration);
}

int check_tracker(const Session& session, proto::TrackerTouch touch) {
  be_patient(session, touch.for_ms);
  if (!touch.point) {
    const auto text = session.client.request(proto::TrackerList{});
    if (!text) return fail(text.error());
    const auto list = proto::decode_message<proto::TrackerListResult>(*text);
    if (!list) return fail(list.error());
    const std::string id = touch.sensor.substr(0, touch.sensor.rfind(':'));
    for (const proto::TrackerEntry& tracker : list->trackers) {
      for (const Calibration& c : tracker.calibrations) {
        if (tracker.tracker == id && c.name == tracker.calibration && !c.points.empty())
          touch.point = c.points[0].world;
      }
    }
    if (!touch.point)
      return fail({"bad_usage", id + " has no alignment with a reference point", "", "say the point: X Y Z"});
  }
  const Vec3 p = *touch.point;
  say(format("Touch [%g %g %g] with %s.", p.x, p.y, p.z, touch.sensor.c_str()));
  return request<proto::TouchResult>(session, touch, [](const proto::TouchResult& r) {
    print_line(format("%.1f mm off: [%.4f %.4f %.4f] m, spread %.1f mm over %d samples", r.off_m.value_or(0.0) * 1e3,
                      r.position.x, r.position.y, r.position.z, r.spread_m * 1e3, r.samples));
  });
}

int boresight_tracker(const Session& session, const proto::TrackerBoresight& boresight) {
  be_patient(session, boresight.for_ms);
  return request<proto::CalibrationResult>(session, boresight, print_calibration);
}

int forget_calibration(const Session& session, const proto::TrackerForget& forget) {
  return done(session, forget, "calibration " + forget.name + " of " + forget.tracker + " is gone");
}

}  // namespace posed::cli
