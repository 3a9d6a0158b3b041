#include "server/solver/body_tree.h"

#include "common/names.h"
#include "server/solver/figure_check.h"

namespace posed {
namespace {

void append_rest(const Joint& joint, bool is_free, std::vector<double>& q) {
  if (is_free) {
    const Vec3& p = joint.parent_from_joint.position;
    q.insert(q.end(), {p.x, p.y, p.z});
    const auto r = xyzw(joint.parent_from_joint.rotation);
    q.insert(q.end(), r.begin(), r.end());
  } else if (q_size(joint.type) == 4) {
    q.insert(q.end(), {0.0, 0.0, 0.0, 1.0});
  } else if (q_size(joint.type) == 1) {
    q.push_back(0.0);
  }
}

}  // namespace

Result<BodyTree> BodyTree::build(const FigureDocument& document) {
  if (auto error = check_figure(document)) return *error;
  BodyTree tree;
  tree.document_ = document;
  for (int i = 0; i < static_cast<int>(document.segments.size()); ++i) {
    Segment& s = tree.document_.segments[static_cast<std::size_t>(i)];
    Joint& joint = s.joint;
    joint.parent_from_joint.rotation = glm::normalize(joint.parent_from_joint.rotation);
    for (Vec3& axis : joint.axes) axis = glm::normalize(axis);
    if (joint.swing && joint.swing->center != kZero) joint.swing->center = glm::normalize(joint.swing->center);
    if (joint.swing) {
      for (Vec3& corner : joint.swing->corners) corner = glm::normalize(corner);
    }
    if (joint.bend_axis != kZero) joint.bend_axis = glm::normalize(joint.bend_axis);

    tree.parents_.push_back(i == 0 ? -1 : tree.segments_.find(s.parent)->second);
    tree.segments_.emplace(s.name, i);
    tree.joints_.emplace(joint.name, i);
    tree.q_at_.push_back(static_cast<int>(tree.rest_.size()));
    tree.dof_ += degrees_of_freedom(joint.type);
    append_rest(joint, joint.type == JointType::free, tree.rest_);
  }
  for (const auto& [alias, name] : document.aliases) tree.segments_.emplace(alias, tree.segments_.find(name)->second);
  return tree;
}

std::optional<int> BodyTree::find_segment(std::string_view name) const {
  const auto found = segments_.find(name);
  return found == segments_.end() ? std::nullopt : std::optional<int>(found->second);
}

std::optional<int> BodyTree::find_joint(std::string_view name) const {
  const auto found = joints_.find(name);
  return found == joints_.end() ? std::nullopt : std::optional<int>(found->second);
}

Result<AttachedPoint> BodyTree::attach(const Attachment& at) const {
  std::optional<int> i;
  if (!at.segment.empty() || at.site.empty()) {
    i = find_segment(at.segment);
    if (!i) {
      return Error{"unknown_segment", "no segment is called " + at.segment.substr(0, 64), "",
                   did_you_mean(at.segment, keys(segments_))};
    }
  }
  if (at.site.empty()) return AttachedPoint{*i, at.point ? *at.point : segment(*i).touch_point};

  const std::string name = i ? segment(*i).name + "/" + at.site : at.site;
  const auto site = document_.sites.find(name);
  if (site == document_.sites.end()) {
    return Error{"unknown_site", "no site is called " + name.substr(0, 130), "",
                 did_you_mean(name, keys(document_.sites))};
  }
  return AttachedPoint{segments_.find(site->second.segment)->second, site->second.point};
}

}  // namespace posed
