// PLY before Assimp sees it: whole, not understood, or refused because data is missing.
#include "base/error.h"
#include "import/model_builder.h"
#include "import/ply_check.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  using namespace std::string_literals;  // of their own length, with the zeros in them
  const std::string big =
      "ply\nformat binary_big_endian 1.0\nelement face 2\nproperty list ushort double w\n"
      "property uchar flag\nend_header\n"
      "\0\1xxxxxxxx\7\0\0\7"s;
  return {import::binary_ply(2), text, big, "ply\nformat ascii 1.0\nelement vertex 1\nend_header\n"};
}

}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  try {
    import::check_ply(fuzz::text_of(data, size));
  } catch (const InputError& error) {
    fuzz::require(std::string_view(error.what()).starts_with("is cut off"), "only missing data is refused");
  }
  return 0;
}
