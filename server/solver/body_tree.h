// The body tree: a figure document that has been checked, with its indices (paper, "Body representation", Figure 12).
// Immutable once built, so it may be shared between threads. Segments keep the document's order: parents first, root 0.
// A joint has the index of the segment that it joins to its parent.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/figure.h"
#include "common/goal.h"
#include "common/result.h"

namespace posed {

// A point that a goal can hold: `point` is in the segment's frame, metres.
struct AttachedPoint {
  int segment = 0;
  Vec3 point{0.0, 0.0, 0.0};
};

class BodyTree {
 public:
  // Errors: "bad_figure", see figure_check.h. Quaternions and axes are normalised on the way in.
  static Result<BodyTree> build(const FigureDocument& document);

  const FigureDocument& document() const { return document_; }
  int size() const { return static_cast<int>(parents_.size()); }
  const Segment& segment(int i) const { return document_.segments[static_cast<std::size_t>(i)]; }
  const Joint& joint(int i) const { return segment(i).joint; }
  int parent(int i) const { return parents_[static_cast<std::size_t>(i)]; }  // -1: the root
  std::span<const int> parents() const { return parents_; }
  bool root_is_free() const { return joint(0).type == JointType::free; }

  // Where joint i's share of q begins; its size is q_size(joint(i).type).
  int q_at(int i) const { return q_at_[static_cast<std::size_t>(i)]; }
  int q_size() const { return static_cast<int>(rest_.size()); }
  int dof() const { return dof_; }

  // The document's own placement: no joint moved; a free root where its joint's position and quat_xyzw say.
  const std::vector<double>& rest() const { return rest_; }

  std::optional<int> find_segment(std::string_view name_or_alias) const;
  std::optional<int> find_joint(std::string_view name) const;

  // Errors: "unknown_segment" and "unknown_site", with a hint and an empty path.
  Result<AttachedPoint> attach(const Attachment& at) const;

 private:
  BodyTree() = default;

  FigureDocument document_;
  std::vector<int> parents_;
  std::vector<int> q_at_;
  std::vector<double> rest_;
  std::map<std::string, int, std::less<>> segments_;  // names and aliases
  std::map<std::string, int, std::less<>> joints_;
  int dof_ = 0;
};

}  // namespace posed
