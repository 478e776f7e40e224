#include "import/gltf_accessor.h"

#include <cstring>
#include <string_view>

#include "base/error.h"

namespace scene_analyzer::import {
namespace {

using nlohmann::json;

enum Component : std::uint64_t {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126,
};

std::uint64_t bytes_of(std::uint64_t component, const std::string& where) {
  switch (component) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      throw InputError(where + " has the unknown component type " + std::to_string(component));
  }
}

std::uint64_t width_of(const json& accessor, const std::string& where) {
  const auto member = accessor.find("type");
  if (member == accessor.end() || !member->is_string()) throw InputError(where + " has no \"type\"");
  const std::string& type = member->get_ref<const std::string&>();
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  throw InputError(where + " has the type " + type + ", which is not for vertices");
}

const json& item(const json& root, const char* list, std::uint64_t number, const std::string& where) {
  const json& items = array_of(root, list, "the file");
  if (number >= items.size())
    throw InputError(where + " uses entry " + std::to_string(number) + " of \"" + list +
                     "\", which does not exist");
  if (!items[number].is_object())
    throw InputError("entry " + std::to_string(number) + " of \"" + list + "\" is not an object");
  return items[number];
}

// The place of the first index that is not below `vertices`, or `count`.
template <typename T>
std::uint64_t first_bad(std::span<const std::uint8_t> data, std::uint64_t stride, std::uint64_t count,
                        std::uint64_t vertices, std::uint64_t& value) {
  for (std::uint64_t i = 0; i < count; ++i) {
    T index;
    std::memcpy(&index, data.data() + i * stride, sizeof index);
    if (index < vertices) continue;
    value = index;
    return i;
  }
  return count;
}

}  // namespace

void GltfAccessors::check_views() const {
  const json& views = array_of(document_.root, "bufferViews", "the file");
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string where = "buffer view " + std::to_string(i);
    const std::uint64_t buffer = whole_number(views[i], "buffer", where);
    const std::uint64_t offset = whole_number(views[i], "byteOffset", 0, where);
    const std::uint64_t length = whole_number(views[i], "byteLength", where);
    if (buffer >= document_.buffers.size())
      throw InputError(where + " uses buffer " + std::to_string(buffer) + ", which does not exist");
    const std::uint64_t room = document_.buffers[buffer].size();
    if (offset > room || length > room - offset)
      throw InputError(where + " ends at byte " + std::to_string(offset) + " + " + std::to_string(length) +
                       " of a buffer of " + std::to_string(room) + " bytes");
  }
}

std::span<const std::uint8_t> GltfAccessors::elements(std::uint64_t view, std::uint64_t offset,
                                                      std::uint64_t count, std::uint64_t bytes_each,
                                                      std::uint64_t& stride, const std::string& where) const {
  const json& entry = item(document_.root, "bufferViews", view, where);
  const std::string name = "buffer view " + std::to_string(view);
  stride = whole_number(entry, "byteStride", bytes_each, name);
  if (stride < bytes_each)
    throw InputError(name + " has a stride of " + std::to_string(stride) + " bytes for elements of " +
                     std::to_string(bytes_each));
  const std::span<const std::uint8_t> bytes = document_.buffers[whole_number(entry, "buffer", name)].subspan(
      whole_number(entry, "byteOffset", 0, name), whole_number(entry, "byteLength", name));
  const bool fits = offset <= bytes.size() &&
                    (count == 0 || (bytes.size() - offset >= bytes_each &&
                                    (count - 1) <= (bytes.size() - offset - bytes_each) / stride));
  if (!fits)
    throw InputError(where + " counts " + std::to_string(count) + " elements, more than " + name + " of " +
                     std::to_string(bytes.size()) + " bytes holds");
  return bytes.subspan(offset);
}

void GltfAccessors::check_sparse(const json& sparse, const Accessor& accessor,
                                 const std::string& where) const {
  const std::uint64_t count = whole_number(sparse, "count", where + " sparse");
  if (count > accessor.count) throw InputError(where + " replaces more elements than it has");
  const auto indices = sparse.find("indices"), values = sparse.find("values");
  if (indices == sparse.end() || values == sparse.end())
    throw InputError(where + " has a sparse part without data");
  std::uint64_t stride = 0, bad_value = 0;
  const std::uint64_t type = whole_number(*indices, "componentType", where + " sparse indices");
  const std::span<const std::uint8_t> places =
      elements(whole_number(*indices, "bufferView", where + " sparse indices"),
               whole_number(*indices, "byteOffset", 0, where + " sparse indices"), count,
               bytes_of(type, where), stride, where);
  const std::uint64_t bad =
      type == kUnsignedByte    ? first_bad<std::uint8_t>(places, stride, count, accessor.count, bad_value)
      : type == kUnsignedShort ? first_bad<std::uint16_t>(places, stride, count, accessor.count, bad_value)
                               : first_bad<std::uint32_t>(places, stride, count, accessor.count, bad_value);
  if (bad < count)
    throw InputError(where + " replaces element " + std::to_string(bad_value) + " of " +
                     std::to_string(accessor.count));
  elements(whole_number(*values, "bufferView", where + " sparse values"),
           whole_number(*values, "byteOffset", 0, where + " sparse values"), count,
           accessor.width * bytes_of(accessor.component, where), stride, where);
}

GltfAccessors::Accessor GltfAccessors::look_up(std::uint64_t number, bool compressed,
                                               const std::string& where) const {
  const json& entry = item(document_.root, "accessors", number, where);
  const std::string name = "accessor " + std::to_string(number);
  Accessor accessor;
  accessor.count = whole_number(entry, "count", name);
  accessor.component = whole_number(entry, "componentType", name);
  accessor.width = width_of(entry, name);
  if (accessor.count > 0xFFFFFFFF)
    throw InputError(name + " counts " + std::to_string(accessor.count) + " elements");
  const std::uint64_t bytes_each = accessor.width * bytes_of(accessor.component, name);
  const auto sparse = entry.find("sparse");
  accessor.sparse = sparse != entry.end();
  if (accessor.sparse) check_sparse(*sparse, accessor, name);
  if (compressed) return accessor;
  if (!entry.contains("bufferView")) {
    if (!accessor.sparse) throw InputError(name + " has no buffer view: all its values would be 0");
    return accessor;  // zeros but for what is replaced
  }
  accessor.data =
      elements(whole_number(entry, "bufferView", name), whole_number(entry, "byteOffset", 0, name),
               accessor.count, bytes_each, accessor.stride, name);
  return accessor;
}

std::uint64_t GltfAccessors::check_positions(std::uint64_t accessor, bool compressed,
                                             const std::string& where) const {
  const Accessor positions = look_up(accessor, compressed, where);
  if (positions.width != 3 || positions.component != kFloat)
    throw InputError(where +
                     " has positions that are not three floats; quantised positions are not supported");
  return positions.count;
}

void GltfAccessors::check_texture_coordinates(std::uint64_t accessor, bool compressed, std::uint64_t vertices,
                                              const std::string& where) const {
  const Accessor coordinates = look_up(accessor, compressed, where);
  if (coordinates.width != 2) throw InputError(where + " has texture coordinates that are not pairs");
  if (coordinates.count != vertices)
    throw InputError(where + " has " + std::to_string(coordinates.count) + " texture coordinates for " +
                     std::to_string(vertices) + " vertices");
}

std::uint64_t GltfAccessors::check_indices(std::uint64_t accessor, bool compressed, std::uint64_t vertices,
                                           const std::string& where) const {
  const Accessor indices = look_up(accessor, compressed, where);
  const bool is_unsigned = indices.component == kUnsignedByte || indices.component == kUnsignedShort ||
                           indices.component == kUnsignedInt;
  if (indices.width != 1 || !is_unsigned)
    throw InputError(where + " has indices that are not unsigned numbers");
  if (compressed) return indices.count;
  if (indices.sparse) throw InputError(where + " has sparse indices, which are not supported");
  std::uint64_t value = 0;
  const std::uint64_t bad =
      indices.component == kUnsignedByte
          ? first_bad<std::uint8_t>(indices.data, indices.stride, indices.count, vertices, value)
      : indices.component == kUnsignedShort
          ? first_bad<std::uint16_t>(indices.data, indices.stride, indices.count, vertices, value)
          : first_bad<std::uint32_t>(indices.data, indices.stride, indices.count, vertices, value);
  if (bad < indices.count)
    throw InputError(where + " asks for vertex " + std::to_string(value) + " of " + std::to_string(vertices) +
                     " (triangle " + std::to_string(bad / 3) + ")");
  return indices.count;
}

}  // namespace scene_analyzer::import
