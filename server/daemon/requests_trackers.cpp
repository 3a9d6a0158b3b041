// Trackers: how they are, who holds them, their settings, and where they stand in the world.
#include <algorithm>

#include "common/names.h"
#include "server/calibration/apply.h"
#include "server/calibration/measure.h"
#include "server/calibration/pivot.h"
#include "server/calibration/rigid_fit.h"
#include "server/daemon/requests.h"
#include "server/daemon/sensor_message.h"

namespace posed {
namespace {

std::vector<std::string> sensors_of(const std::string& id, const TrackerState& tracker) {
  std::vector<std::string> sensors;
  for (const int station : tracker.stations) sensors.push_back(sensor_id(id, station));
  return sensors;
}

Error no_samples(const std::string& sensor, int for_ms) {
  return {"no_signal", sensor + " has sent nothing for " + std::to_string(for_ms) + " ms", "/sensor",
          "is it plugged in, and within the field? tracker.list tells how its tracker is"};
}

}  // namespace

const char* tracker_state_name(tracker::State state) {
  switch (state) {
    case tracker::State::searching:
      return "searching";
    case tracker::State::starting:
      return "starting";
    case tracker::State::streaming:
      return "streaming";
    case tracker::State::silent:
      return "silent";
    case tracker::State::failed:
      return "failed";
  }
  return "failed";
}

void Requests::on(const proto::TrackerList&, Responder responder) {
  proto::TrackerListResult result;
  for (const auto& [id, tracker] : p_.trackers) {
    const tracker::Status& status = tracker.status;
    proto::TrackerEntry& entry = result.trackers.emplace_back();
    entry.tracker = id;
    entry.kind = tracker.kind;
    entry.state = tracker_state_name(status.state);
    entry.message = status.message;
    entry.rate_hz = status.rate_hz;
    entry.frames = tracker.frames;
    entry.bad_bytes = status.bad_bytes;
    entry.sensors = sensors_of(id, tracker);
    entry.held_by = p_.tracker_holds.holder(id, p_.clock.now());
    const Calibrations::OfTracker& of_tracker = p_.calibrations.of(id);
    entry.calibration = of_tracker.chosen;
    for (const auto& [name, calibration] : of_tracker.kept) entry.calibrations.push_back(calibration);
  }
  responder.result(result);
}

// That it is there, and nobody else's. Whoever holds it goes on holding it.
Status Requests::may_touch(const std::string& tracker, bool force, Nanoseconds busy_for) {
  if (!p_.trackers.contains(tracker)) {
    const std::string hint = did_you_mean(tracker, keys(p_.trackers));
    return Error{"unknown_tracker", "no tracker is called " + tracker.substr(0, 64), "/tracker",
                 hint.empty() ? "posed --tracker KIND starts one" : hint};
  }
  const Nanoseconds now = p_.clock.now();
  if (!force) {
    if (Status free = p_.tracker_holds.check(tracker, connection_, now); !free) return free;
  }
  p_.tracker_holds.renew(tracker, connection_, now, busy_for);
  return Ok{};
}

Result<SensorName> Requests::find_sensor(const std::string& name, bool force, Nanoseconds busy_for) {
  const Result<SensorName> sensor = read_sensor(name);
  if (!sensor) return sensor;
  if (const Status free = may_touch(sensor->device, force, busy_for); !free) {
    Error error = free.error();
    error.path = "/sensor";
    return error;
  }
  const TrackerState& tracker = p_.trackers.at(sensor->device);
  if (std::find(tracker.stations.begin(), tracker.stations.end(), sensor->station) != tracker.stations.end())
    return sensor;
  const std::string hint = did_you_mean(name, sensors_of(sensor->device, tracker));
  return Error{"unknown_sensor", "tracker " + sensor->device + " hears no sensor " + std::to_string(sensor->station),
               "/sensor", hint.empty() ? "tracker.list tells how it is" : hint};
}

void Requests::on(const proto::TrackerGrab& m, Responder responder) {
  if (const Status free = may_touch(m.tracker, m.force); !free) return responder.params_error(free.error());
  p_.tracker_holds.take(m.tracker, connection_, by().editor.name, p_.clock.now());
  responder.result(proto::TrackerGrabResult{m.tracker, static_cast<int>(Holds::kIdle / 1'000'000)});
}

void Requests::on(const proto::TrackerRelease& m, Responder responder) {
  if (const Status free = may_touch(m.tracker, m.force); !free) return responder.params_error(free.error());
  p_.tracker_holds.release(m.tracker);
  responder.result(proto::EmptyResult{});
}

void Requests::on(const proto::TrackerConfigure& m, Responder responder) {
  if (const Status free = may_touch(m.tracker, m.force); !free) return responder.params_error(free.error());
  tracker::Settings settings;
  if (const Status read = read_settings(m, settings); !read) return responder.params_error(read.error());
  const Calibrations::OfTracker before = p_.calibrations.of(m.tracker);
  if (m.calibration.named()) {
    const std::string name = m.calibration.value() ? *m.calibration.value() : "";
    if (const Status chosen = p_.calibrations.choose(m.tracker, name); !chosen)
      return responder.params_error(chosen.error());
  }
  if (const Status taken = p_.configure_device(m.tracker, settings); !taken) {
    p_.calibrations.restore(m.tracker, before);
    return responder.params_error(taken.error());
  }
  keep_calibrations(m.tracker, before, std::move(responder), proto::encode_result(proto::EmptyResult{}));
}

void Requests::on(const proto::TrackerReset& m, Responder responder) {
  if (const Status free = may_touch(m.tracker, m.force); !free) return responder.params_error(free.error());
  const Calibrations::OfTracker before = p_.calibrations.of(m.tracker);
  tracker::Settings defaults;
  defaults.reset = true;
  if (const Status taken = p_.configure_device(m.tracker, defaults); !taken)
    return responder.params_error(taken.error());
  (void)p_.calibrations.choose(m.tracker, "");
  keep_calibrations(m.tracker, before, std::move(responder), proto::encode_result(proto::EmptyResult{}));
}

void Requests::on(const proto::TrackerTouch& m, Responder responder) {
  const Nanoseconds duration = Nanoseconds{m.for_ms} * 1'000'000;
  const Result<SensorName> sensor = find_sensor(m.sensor, m.force, duration);
  if (!sensor) return responder.params_error(sensor.error());
  const Status begun =
      p_.measuring.begin(*sensor, duration, [&p = p_, m, sensor = *sensor, responder](auto poses) mutable {
        if (poses.empty()) return responder.params_error(no_samples(m.sensor, m.for_ms));
        const Calibration* chosen = p.calibrations.chosen(sensor.device);
        const Calibration& calibration = chosen ? *chosen : Calibration{};
        for (Transform& pose : poses) pose = calibration::source_from_tip(calibration, sensor.station, pose);
        const calibration::Still still = calibration::average(poses);
        const Transform world = calibration.world_from_source * still.mean;
        proto::TouchResult result;
        result.sensor = m.sensor;
        result.samples = static_cast<int>(poses.size());
        result.position = world.position;
        result.rotation = glm::normalize(world.rotation);
        result.source = still.mean.position;
        result.spread_m = still.spread_m;
        if (m.point) result.off_m = glm::length(world.position - *m.point);
        responder.result(result);
      });
  if (!begun) responder.params_error(begun.error());
}

void Requests::on(const proto::TrackerAlign& m, Responder responder) {
  if (const Status free = may_touch(m.tracker, m.force); !free) return responder.params_error(free.error());
  if (const Status good = check_name(m.name); !good) return responder.params_error(good.error());
  Result<calibration::RigidFit> fit = calibration::fit_rigid(m.points);
  if (!fit) return responder.params_error(fit.error());
  Calibration calibration = p_.calibrations.begin(m.tracker, m.name);
  calibration.world_from_source = fit->world_from_source;
  calibration.residual_m = fit->residual_m;
  calibration.points = std::move(fit->points);
  put_calibration(std::move(calibration), std::move(responder));
}

void Requests::on(const proto::TrackerTip& m, Responder responder) {
  const Nanoseconds duration = m.offset ? 0 : Nanoseconds{m.for_ms} * 1'000'000;
  const Result<SensorName> sensor = find_sensor(m.sensor, m.force, duration);
  if (!sensor) return responder.params_error(sensor.error());
  if (const Status good = check_name(m.name); !good) return responder.params_error(good.error());
  auto put = [self = *this, m, sensor = *sensor](const TipOffset& tip, Responder to) mutable {
    Calibration calibration = self.p_.calibrations.begin(sensor.device, m.name);
    calibration.sensors[std::to_string(sensor.station)].tip = tip;
    self.put_calibration(std::move(calibration), std::move(to));
  };
  if (m.offset) {
    if (!(glm::length(*m.offset) <= 10.0))
      return responder.params_error({"out_of_range", "the tip is too far from its sensor", "/offset", "within 10 m"});
    return put({*m.offset, 0.0, 0}, std::move(responder));
  }
  const Status begun = p_.measuring.begin(*sensor, duration, [m, put, responder](auto poses) mutable {
    if (poses.empty()) return responder.params_error(no_samples(m.sensor, m.for_ms));
    const Result<TipOffset> tip = calibration::fit_pivot(poses);
    if (!tip) return responder.params_error(tip.error());
    put(*tip, responder);
  });
  if (!begun) responder.params_error(begun.error());
}

void Requests::on(const proto::TrackerBoresight& m, Responder responder) {
  const Nanoseconds duration = Nanoseconds{m.for_ms} * 1'000'000;
  const Result<SensorName> sensor = find_sensor(m.sensor, m.force, duration);
  if (!sensor) return responder.params_error(sensor.error());
  if (const Status good = check_name(m.name); !good) return responder.params_error(good.error());
  const Status begun =
      p_.measuring.begin(*sensor, duration, [self = *this, m, sensor = *sensor, responder](const auto& poses) mutable {
        if (poses.empty()) return responder.params_error(no_samples(m.sensor, m.for_ms));
        Calibration calibration = self.p_.calibrations.begin(sensor.device, m.name);
        const Quat present = calibration.world_from_source.rotation * calibration::average(poses).mean.rotation;
        calibration.sensors[std::to_string(sensor.station)].boresight =
            glm::normalize(glm::conjugate(present) * m.rotation);
        self.put_calibration(std::move(calibration), std::move(responder));
      });
  if (!begun) responder.params_error(begun.error());
}

void Requests::on(const proto::TrackerForget& m, Responder responder) {
  if (const Status free = may_touch(m.tracker, m.force); !free) return responder.params_error(free.error());
  const Calibrations::OfTracker before = p_.calibrations.of(m.tracker);
  if (const Status gone = p_.calibrations.forget(m.tracker, m.name); !gone) return responder.params_error(gone.error());
  keep_calibrations(m.tracker, before, std::move(responder), proto::encode_result(proto::EmptyResult{}));
}

Status Requests::check_name(const std::string& name) const {
  if (name.empty() || valid_id(name)) return Ok{};
  return Error{"bad_id", "the name is no id", "/name", "letters, digits, '_', '.' and '-', at most 64"};
}

Status Requests::read_settings(const proto::TrackerConfigure& m, tracker::Settings& settings) const {
  const auto station_of = [&m](const std::string& name, const std::string& path) -> Result<int> {
    const Result<SensorName> sensor = read_sensor(name);
    if (sensor && sensor->device == m.tracker) return sensor->station;
    return Error{"unknown_sensor", name.substr(0, 64) + " is no sensor of " + m.tracker, path,
                 "as in " + sensor_id(m.tracker, 1)};
  };
  settings.rate_hz = m.rate_hz;
  if (m.sensors.is_reset()) settings.stations = Patched<std::vector<int>>::reset();
  if (const auto* sensors = m.sensors.value()) {
    std::vector<int> stations;
    for (std::size_t i = 0; i < sensors->size(); ++i) {
      const Result<int> station = station_of((*sensors)[i], "/sensors/" + std::to_string(i));
      if (!station) return station.error();
      stations.push_back(*station);
    }
    settings.stations = std::move(stations);
  }
  for (const auto& [name, zenith] : m.hemisphere) {
    const Result<int> station = station_of(name, "/hemisphere/" + name.substr(0, 64));
    if (!station) return station.error();
    settings.hemispheres[*station] = zenith;
  }
  const auto filter = [](const Patched<proto::DeviceFilter>& from, Patched<tracker::FilterSetting>& to) {
    if (from.is_reset()) to = Patched<tracker::FilterSetting>::reset();
    if (const auto* f = from.value()) to = tracker::FilterSetting{f->on, f->sensitivity, f->low, f->high, f->most};
  };
  filter(m.position_filter, settings.position_filter);
  filter(m.attitude_filter, settings.attitude_filter);
  return Ok{};
}

void Requests::put_calibration(Calibration calibration, Responder responder) {
  const std::string tracker = calibration.tracker;
  Calibrations::OfTracker before = p_.calibrations.of(tracker);
  calibration.utc_ns = utc_now();
  calibration.author = by().editor.name;
  const std::string result = proto::encode_result(proto::CalibrationResult{calibration});
  p_.calibrations.put(std::move(calibration));
  keep_calibrations(tracker, std::move(before), std::move(responder), result);
}

// The reply waits for the disk. Where it takes nothing, what was before is there again.
void Requests::keep_calibrations(const std::string& tracker, Calibrations::OfTracker before, Responder responder,
                                 const std::string& result) {
  Done done;
  done.entities = p_.calibrations.paths(tracker);
  for (const auto& [name, calibration] : before.kept) {
    if (!p_.calibrations.of(tracker).kept.contains(name)) done.entities.push_back(Calibrations::path(tracker, name));
  }
  p_.journal.add(std::move(done), "");
  p_.journal.when_stored(
      [&p = p_, tracker, before = std::move(before), responder, result](const Status& stored) mutable {
        if (!stored) {
          p.calibrations.restore(tracker, std::move(before));
          return responder.error(stored.error());
        }
        responder.deliver(responder.reply_text(result));
      });
  p_.store_soon();
}

}  // namespace posed
