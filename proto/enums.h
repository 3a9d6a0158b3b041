// Private to the codec: the words of the wire for each enumeration.
#pragma once

#include <array>
#include <string>

#include "proto/messages.h"

namespace posed::proto {

template <class E>
struct EnumNames;

template <>
struct EnumNames<JointType> {
  static constexpr std::array names{"free", "ball", "universal", "hinge", "prismatic", "fixed"};
};
template <>
struct EnumNames<Shape::Kind> {
  static constexpr std::array names{"capsule", "ellipsoid", "box"};
};
template <>
struct EnumNames<GoalKind> {
  static constexpr auto names = kGoalKindNames;
};
template <>
struct EnumNames<PlaneTarget::Side> {
  static constexpr std::array names{"on", "above"};
};
template <>
struct EnumNames<DistanceTarget::Compare> {
  static constexpr std::array names{"equal", "at_least", "at_most"};
};
template <>
struct EnumNames<Pin::Hold> {
  static constexpr std::array names{"position", "orientation", "pose"};
};
template <>
struct EnumNames<Cause::Side> {
  static constexpr std::array names{"min", "max", "swing"};
};
template <>
struct EnumNames<Start::Kind> {
  static constexpr std::array names{"rest", "current", "q"};
};
template <>
struct EnumNames<Binding::Mode> {
  static constexpr std::array names{"absolute", "relative"};
};
template <>
struct EnumNames<ButtonAction::Do> {
  static constexpr auto names = kButtonActionNames;
};
template <>
struct EnumNames<GoalState> {
  static constexpr std::array names{"off", "reached", "unreachable", "limited", "balanced"};
};
template <>
struct EnumNames<SolveStatus> {
  static constexpr std::array names{"converged", "deadline", "stalled"};
};
template <>
struct EnumNames<Stream> {
  static constexpr std::array names{"pose", "tracker", "scene", "stats", "camera"};
};

template <>
struct EnumNames<Role> {
  static constexpr std::array names{"none", "viewer", "editor", "operator"};
};
template <>
struct EnumNames<Encoding> {
  static constexpr std::array names{"json", "cbor"};
};

template <class E>
const char* word(E value) {
  return EnumNames<E>::names[static_cast<std::size_t>(value)];
}

template <class E>
std::string enum_words() {
  std::string all = "one of:";
  for (const char* name : EnumNames<E>::names) all.append(" ").append(name);
  return all;
}

}  // namespace posed::proto
