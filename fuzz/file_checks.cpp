// The first look at any file. The first byte chooses the extension.
#include "import/file_checks.h"

#include <array>

#include "asset_in_memory.h"
#include "base/error.h"
#include "import/gltf_builder.h"
#include "import/model_builder.h"
#include "target.h"

namespace scene_analyzer::fuzz {
namespace {

constexpr std::array<const char*, 8> kNames = {"a.stl", "a.ply", "a.obj",   "a.x3d",
                                               "a.dxf", "a.smd", "a.blend", "a"};

}  // namespace

std::vector<std::string> seeds() {
  using namespace std::string_literals;
  return {"\0"s + import::binary_stl(2),
          "\0solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\nendsolid a\n"s,
          "\1"s + import::binary_ply(1),
          "\2v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"s,
          "\2\xFF\xFEv\0 \0"s,
          "\2version https://git-lfs.github.com/spec/v1\noid sha256:0\n"s,
          "\2  <!DOCTYPE html>"s,
          "\3<X3D></X3D>"s,
          "\4"
          "0\nEOF\n"s,
          "\5version 1\nend\n"s,
          "\6\x1F\x8B"s,
          "\7" + import::QuadGltf().binary()};
}

}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  if (size == 0) return 0;
  const std::string name = fuzz::kNames[data[0] % fuzz::kNames.size()];
  fuzz::set_asset(fuzz::text_of(data + 1, size - 1));
  std::vector<std::string> warnings;
  try {
    import::check_file(name, warnings);
  } catch (const InputError& error) {
    fuzz::require(*error.what() != '\0', "a refusal has a reason");
  }
  return 0;
}
