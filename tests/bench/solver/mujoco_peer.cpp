// MuJoCo's kinematics (mj_kinematics) under the Levenberg-Marquardt method of dual_lm.h. The Jacobian is made from the
// joints' axes and anchors in the world, which costs less than mj_comPos and mj_jac.
#include <mujoco/mujoco.h>

#include <cstring>
#include <stdexcept>

#include "tests/bench/solver/dual_lm.h"

namespace posed::test {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    char word[32];
    std::snprintf(word, sizeof word, "%.17g ", value);
    text += word;
  }
  return text;
}

// Points are kept by us, so that MuJoCo has no sites to carry along.
std::string body_xml(const HingeFigure& figure, int i) {
  const auto& parts = figure.parts();
  const Part& part = parts[static_cast<std::size_t>(i)];
  const Vec3& at = part.parent_from_joint.position;
  const Quat& turn = part.parent_from_joint.rotation;
  std::string xml = "<body pos='" + numbers({at.x, at.y, at.z}) + "' quat='" +
                    numbers({turn.w, turn.x, turn.y, turn.z}) +
                    "'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>";
  if (i == 0) xml += "<freejoint/>";
  for (int h = part.first_hinge; h < part.first_hinge + part.hinges; ++h) {
    const Vec3& axis = figure.hinges()[static_cast<std::size_t>(h)].axis;
    xml += "<joint type='hinge' axis='" + numbers({axis.x, axis.y, axis.z}) + "'/>";
  }
  for (int child = i + 1; child < static_cast<int>(parts.size()); ++child) {
    if (parts[static_cast<std::size_t>(child)].parent == i) xml += body_xml(figure, child);
  }
  return xml + "</body>";
}

mjModel* model_of(const HingeFigure& figure) {
  const std::string xml =
      "<mujoco><compiler angle='radian'/><worldbody>" + body_xml(figure, 0) + "</worldbody></mujoco>";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  if (mj_makeEmptyFileVFS(files.get(), "figure.xml", static_cast<int>(xml.size())) != 0) return nullptr;
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[500] = "";
  mjModel* const model = mj_loadXML("figure.xml", files.get(), error, sizeof error);
  mj_deleteFileVFS(files.get(), "figure.xml");
  if (!model) throw std::runtime_error(std::string("MuJoCo does not take the figure: ") + error);
  return model;
}

// MuJoCo numbers bodies depth first, so its indices are not ours.
class MujocoKinematics {
 public:
  explicit MujocoKinematics(const HingeFigure& figure)
      : figure_(figure), model_(model_of(figure), mj_deleteModel), data_(mj_makeData(model_.get()), mj_deleteData) {
    const auto& parts = figure.parts();
    body_.resize(parts.size());
    joint_.resize(kHinges);
    next_body_ = 1, next_joint_ = 1;
    number(0);
  }

  void place(const std::vector<double>& x) {
    mjtNum* const q = data_->qpos;
    q[0] = x[0], q[1] = x[1], q[2] = x[2];
    q[3] = x[6], q[4] = x[3], q[5] = x[4], q[6] = x[5];
    for (std::size_t h = 0; h < kHinges; ++h) q[kRootSize - 1 + joint_[h]] = x[kRootSize + h];
    mj_kinematics(model_.get(), data_.get());
  }

  Vec3 point(const AttachedPoint& at) const {
    const int body = body_[static_cast<std::size_t>(at.segment)];
    const mjtNum* const p = data_->xpos + 3 * body;
    const mjtNum* const m = data_->xmat + 9 * body;
    const Vec3& v = at.point;
    return {p[0] + m[0] * v.x + m[1] * v.y + m[2] * v.z, p[1] + m[3] * v.x + m[4] * v.y + m[5] * v.z,
            p[2] + m[6] * v.x + m[7] * v.y + m[8] * v.z};
  }

  template <class Jacobian>
  void fill(const AttachedPoint& at, Jacobian& jacobian, int row, double scale) const {
    const Vec3 p = point(at);
    const auto write = [&](int column, const Vec3& v) {
      jacobian(row, column) = scale * v.x, jacobian(row + 1, column) = scale * v.y;
      jacobian(row + 2, column) = scale * v.z;
    };
    const Vec3 arm = p - vec(data_->qpos);
    write(0, kX), write(1, kY), write(2, kZ);
    write(3, {0.0, -arm.z, arm.y}), write(4, {arm.z, 0.0, -arm.x}), write(5, {-arm.y, arm.x, 0.0});
    for (const int h : figure_.hinges_above(at.segment)) {
      const int joint = joint_[static_cast<std::size_t>(h)];
      write(6 + h, glm::cross(vec(data_->xaxis + 3 * joint), p - vec(data_->xanchor + 3 * joint)));
    }
  }

 private:
  static Vec3 vec(const mjtNum* v) { return {v[0], v[1], v[2]}; }

  void number(int i) {
    const auto& parts = figure_.parts();
    const Part& part = parts[static_cast<std::size_t>(i)];
    body_[static_cast<std::size_t>(i)] = next_body_++;
    for (int h = part.first_hinge; h < part.first_hinge + part.hinges; ++h) {
      joint_[static_cast<std::size_t>(h)] = next_joint_++;
    }
    for (int child = i + 1; child < static_cast<int>(parts.size()); ++child) {
      if (parts[static_cast<std::size_t>(child)].parent == i) number(child);
    }
  }

  const HingeFigure& figure_;
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
  std::vector<int> body_, joint_;  // of each part, of each hinge
  int next_body_ = 1, next_joint_ = 1;
};

class MujocoPeer final : public Contestant {
 public:
  explicit MujocoPeer(const HingeFigure& figure)
      : kinematics_(figure), one_(figure, kinematics_), four_(figure, kinematics_), eight_(figure, kinematics_) {}

  std::string who() const override { return "mujoco"; }
  void prepare(const Problem& problem, std::span<const double> start, bool stream) override {
    problem_ = &problem;
    x_.assign(start.begin(), start.end());
    stream_ = stream;
  }
  void solve() override {
    switch (problem_->size()) {
      case 1:
        return one_.solve(*problem_, x_, stream_);
      case 4:
        return four_.solve(*problem_, x_, stream_);
      case 8:
        return eight_.solve(*problem_, x_, stream_);
      default:
        throw std::runtime_error("the MuJoCo peer is made for 1, 4 and 8 goals");
    }
  }
  void answer(std::span<double> x) const override { std::copy(x_.begin(), x_.end(), x.begin()); }

 private:
  MujocoKinematics kinematics_;
  DualLm<1, MujocoKinematics> one_;
  DualLm<4, MujocoKinematics> four_;
  DualLm<8, MujocoKinematics> eight_;
  const Problem* problem_ = nullptr;
  std::vector<double> x_;
  bool stream_ = false;
};

}  // namespace

std::unique_ptr<Contestant> mujoco_peer(const HingeFigure& figure) {
  return std::make_unique<MujocoPeer>(figure);
}

}  // namespace posed::test
