// Documents of figures: what is taken means the same when it is said again, and stands as a figure that can be posed.
#include <cstddef>
#include <cstdint>
#include <string>

#include "proto/codec.h"
#include "server/solver/kinematics.h"
#include "server/solver/tempus.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace posed;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Result<FigureDocument> figure = proto::decode_figure(text);
  if (!figure) {
    fuzz::require(!figure.error().code.empty() && !figure.error().message.empty(), "no reason", text);
    return 0;
  }
  const std::string said = proto::encode_figure(*figure);
  const Result<FigureDocument> again = proto::decode_figure(said);
  fuzz::require(again && proto::encode_figure(*again) == said, "not the same figure again", said);
  const Result<BodyTree> tree = BodyTree::build(*figure);
  if (!tree) {
    fuzz::require(!tree.error().code.empty() && !tree.error().message.empty(), "no reason", text);
    return 0;
  }
  std::vector<Transform> world(static_cast<std::size_t>(tree->size()));
  for (const std::vector<double>& q : {tree->rest(), start_pose(*tree)}) {
    fuzz::require(bool(check_q(*tree, q)), "its own pose is refused", text);
    forward_kinematics(*tree, q, world);
    for (const Transform& t : world) fuzz::require(finite(t.position) && finite(t.rotation), "not finite", text);
  }
  return 0;
}
