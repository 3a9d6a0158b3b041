// C++17, see simbody_rig.h. Debian's library was built without NDEBUG, and some of its classes have another layout with
// it.
#undef NDEBUG
#include "tests/bench/solver/simbody_rig.h"

#include <simbody/Simbody.h>

#include <cmath>

namespace posed::test {
namespace {

constexpr int kRootSize = 7;
constexpr double kAccuracy = 1e-4;  // 1e-3 leaves half of a stream's frames more than 1 mm off

SimTK::Vec3 vec(const double* v) {
  return {v[0], v[1], v[2]};
}

// The frame whose x and y are a universal joint's two axes.
SimTK::Rotation along(const double* x, const double* y) {
  return {SimTK::UnitVec3(vec(x)), SimTK::XAxis, vec(y), SimTK::YAxis};
}

SimTK::Rotation rotation(double w, double x, double y, double z) {
  return SimTK::Rotation(SimTK::Quaternion(w, x, y, z));
}

}  // namespace

struct SimbodyRig::Inside {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> bodies;
  std::vector<int> hinges;  // of each body
  SimTK::State state;
  std::unique_ptr<SimTK::Assembler> assembler;
  SimTK::Markers* markers = nullptr;  // the assembler's

  void add(const SimbodyBody& given) {
    const SimTK::Body::Rigid body(SimTK::MassProperties(1.0, SimTK::Vec3(0), SimTK::Inertia(1)));
    const double* const turn = given.quat_wxyz;
    const SimTK::Transform at(rotation(turn[0], turn[1], turn[2], turn[3]), vec(given.position));
    hinges.push_back(given.hinges);
    if (given.hinges == 0) {
      bodies.push_back(SimTK::MobilizedBody::Free(matter.Ground(), body));
      return;
    }
    SimTK::MobilizedBody& parent = bodies[given.parent];
    if (given.hinges == 3) {
      bodies.push_back(SimTK::MobilizedBody::Gimbal(parent, at, body, SimTK::Transform()));
      return;
    }
    const SimTK::Rotation axes = along(given.axes[0], given.axes[1]);
    bodies.push_back(
        SimTK::MobilizedBody::Universal(parent, at * SimTK::Transform(axes), body, SimTK::Transform(axes)));
  }

  void limit(const std::vector<SimbodyBody>& given) {
    for (std::size_t i = 0; i < given.size(); ++i) {
      for (int h = 0; h < given[i].hinges; ++h) {
        if (!std::isfinite(given[i].max[h])) continue;
        assembler->restrictQ(bodies[i].getMobilizedBodyIndex(), SimTK::MobilizerQIndex(h), given[i].min[h],
                             given[i].max[h]);
      }
    }
  }
};

SimbodyRig::SimbodyRig(const std::vector<SimbodyBody>& bodies, const std::vector<SimbodyMarker>& markers)
    : in_(std::make_unique<Inside>()) {
  for (const SimbodyBody& body : bodies) in_->add(body);
  in_->state = in_->system.realizeTopology();
  in_->assembler = std::make_unique<SimTK::Assembler>(in_->system);
  in_->markers = new SimTK::Markers();
  for (const SimbodyMarker& marker : markers) {
    in_->markers->addMarker(in_->bodies[marker.body].getMobilizedBodyIndex(), vec(marker.point), marker.weight);
  }
  in_->assembler->adoptAssemblyGoal(in_->markers);
  in_->limit(bodies);
  in_->assembler->setAccuracy(kAccuracy);
  in_->assembler->initialize(in_->state);
}

SimbodyRig::~SimbodyRig() = default;

void SimbodyRig::aim(int marker, const double* target) {
  in_->markers->moveOneObservation(SimTK::Markers::ObservationIx(marker), vec(target));
}

void SimbodyRig::start_at(const double* x) {
  in_->bodies[0].setQToFitTransform(in_->state, SimTK::Transform(rotation(x[6], x[3], x[4], x[5]), vec(x)));
  const double* angle = x + kRootSize;
  for (std::size_t i = 0; i < in_->bodies.size(); ++i) {
    for (int h = 0; h < in_->hinges[i]; ++h) in_->bodies[i].setOneQ(in_->state, h, *angle++);
  }
  in_->assembler->initialize(in_->state);
}

void SimbodyRig::solve() {
  try {
    in_->assembler->assemble();
  } catch (const std::exception&) {
    // It has not got within its tolerance. What it has reached is its answer all the same.
  }
}

void SimbodyRig::answer(double* x) const {
  SimTK::State state = in_->state;
  in_->assembler->updateFromInternalState(state);
  in_->system.realize(state, SimTK::Stage::Position);
  const SimTK::Transform& root = in_->bodies[0].getBodyTransform(state);
  const SimTK::Quaternion turn = root.R().convertRotationToQuaternion();
  for (int k = 0; k < 3; ++k) x[k] = root.p()[k];
  for (int k = 0; k < 4; ++k) x[3 + k] = turn[(k + 1) % 4];
  double* angle = x + kRootSize;
  for (std::size_t i = 0; i < in_->bodies.size(); ++i) {
    for (int h = 0; h < in_->hinges[i]; ++h) *angle++ = in_->bodies[i].getOneQ(state, h);
  }
}

}  // namespace posed::test
