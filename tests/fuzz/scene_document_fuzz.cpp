// Documents of scenes: what is taken is a scene, and that scene's document makes the same scene again.
#include <cstddef>
#include <cstdint>
#include <string>

#include "proto/codec.h"
#include "server/scene/scene.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace posed;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Result<SceneDocument> document = proto::decode_scene(text);
  if (!document) {
    fuzz::require(!document.error().code.empty() && !document.error().message.empty(), "no reason", text);
    return 0;
  }
  const std::string said = proto::encode_scene(*document);
  const Result<SceneDocument> again = proto::decode_scene(said);
  fuzz::require(again && proto::encode_scene(*again) == said, "not the same document again", said);
  Scene scene, copy;
  if (const Status loaded = scene.load(*document); !loaded) {
    fuzz::require(!loaded.error().code.empty() && !loaded.error().message.empty(), "no reason", text);
    return 0;
  }
  const std::string kept = proto::encode_scene(scene.document());
  const Result<SceneDocument> read = proto::decode_scene(kept);
  fuzz::require(read && copy.load(*read), "what was kept can not be loaded", kept);
  fuzz::require(proto::encode_scene(copy.document()) == kept, "not the same scene again", kept);
  return 0;
}
