// The import worker's answer: whatever a taken-over worker leaves in the shared memory, the reader refuses it
// or hands out a scene that nothing can be read beside of.
#include "import/wire.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>

#include "base/error.h"
#include "import/scene_wire.h"
#include "import/text.h"
#include "import/wire_builder.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> seeds;
  const auto add = [&](const std::vector<std::byte>& bytes) {
    seeds.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  add(import::small_scene());
  add(import::small_scene(7));
  add(import::small_scene(2, {0, 0, {}}));
  const import::MemoryFile refused, exhausted;
  import::wire::Writer writer(refused.descriptor());
  writer.string("is cut off");
  writer.finish(import::wire::Status::kRefused);
  add(refused.contents());
  import::wire::write_header_only(exhausted.descriptor(), import::wire::Status::kOutOfMemory);
  add(exhausted.contents());
  return seeds;
}

namespace {

void check_scene(const mesh::Scene& scene) {
  for (const mesh::TriangleMesh& mesh : scene.meshes) {
    require(mesh.material < scene.materials.size(), "a mesh has a material");
    require(mesh.positions.size() % 3 == 0 && mesh.indices.size() % 3 == 0,
            "positions and triangles are whole");
  }
  for (const mesh::Material& material : scene.materials) {
    require(!material.texture || *material.texture < scene.textures.size(),
            "a texture of a material is there");
    for (const float channel : material.base_color.value_or(std::array<float, 4>{}))
      require(channel >= 0 && channel <= 1, "colours lie in [0, 1]");
  }
  require(!scene.unit_scale || (std::isfinite(*scene.unit_scale) && *scene.unit_scale > 0),
          "units are lengths");
  import::touch(scene);
}

}  // namespace
}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  // Shared memory begins at a page; one that ends where the answer ends shows every step beyond it.
  constexpr std::align_val_t kAlignment{import::wire::kArrayAlignment};
  const auto release = [](std::byte* bytes) { ::operator delete(bytes, kAlignment); };
  const std::unique_ptr<std::byte, decltype(release)> memory(
      static_cast<std::byte*>(::operator new(std::max<std::size_t>(size, 1), kAlignment)), release);
  if (size > 0) std::memcpy(memory.get(), data, size);
  try {
    import::wire::Reader reader({memory.get(), size});
    if (reader.status() == import::wire::Status::kScene)
      fuzz::check_scene(import::read_scene(reader));
    else
      import::clean_text(reader.string(), 2048);
  } catch (const import::wire::Malformed&) {
  } catch (const InputError&) {
  }
  return 0;
}
