// gltf_accessor.h — Bounds and values of the accessors that make geometry.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "import/gltf_document.h"

namespace scene_analyzer::import {

// All checks throw InputError naming `where` ("mesh 0 primitive 1") or the accessor, and return the
// accessor's count. `compressed`: the data is in a Draco stream, so only the count and the type stand in the
// accessor.
class GltfAccessors {
 public:
  explicit GltfAccessors(const GltfDocument& document) : document_(document) {}

  void check_views() const;  // every buffer view lies inside its buffer
  std::uint64_t check_positions(std::uint64_t accessor, bool compressed, const std::string& where) const;
  void check_texture_coordinates(std::uint64_t accessor, bool compressed, std::uint64_t vertices,
                                 const std::string& where) const;
  // Reads every index: each has to be below `vertices`.
  std::uint64_t check_indices(std::uint64_t accessor, bool compressed, std::uint64_t vertices,
                              const std::string& where) const;

 private:
  struct Accessor {
    std::uint64_t count = 0;
    std::uint64_t component = 0;  // glTF's number of the type
    std::uint64_t width = 0;      // components per element
    std::uint64_t stride = 0;
    std::span<const std::uint8_t> data;  // from the first element; empty without a buffer view
    bool sparse = false;
  };

  Accessor look_up(std::uint64_t number, bool compressed, const std::string& where) const;
  std::span<const std::uint8_t> elements(std::uint64_t view, std::uint64_t offset, std::uint64_t count,
                                         std::uint64_t bytes_each, std::uint64_t& stride,
                                         const std::string& where) const;
  void check_sparse(const nlohmann::json& sparse, const Accessor& accessor, const std::string& where) const;

  const GltfDocument& document_;
};

}  // namespace scene_analyzer::import
