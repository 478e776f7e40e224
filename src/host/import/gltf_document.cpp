#include "import/gltf_document.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace scene_analyzer::import {
namespace {

using nlohmann::json;

struct Container {
  std::string_view json;
  std::optional<std::span<const std::uint8_t>> binary;
};

std::uint32_t word(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

void append_word(std::string& bytes, std::size_t value) {
  const auto little = static_cast<std::uint32_t>(value);
  bytes.append(reinterpret_cast<const char*>(&little), sizeof little);
}

// One chunk at `offset`, which moves behind it.
std::string_view take_chunk(std::string_view file, std::size_t& offset, std::string_view type) {
  const std::string name(type.substr(0, type.find('\0')));
  if (file.size() - offset < 8) throw InputError("is cut off before its " + name + " chunk");
  const std::uint64_t bytes = word(file, offset);
  if (file.substr(offset + 4, 4) != type) throw InputError("has no " + name + " chunk where one has to be");
  if (bytes > file.size() - offset - 8)
    throw InputError("is cut off: its " + name + " chunk takes " + std::to_string(bytes) + " bytes and " +
                     std::to_string(file.size() - offset - 8) + " are left");
  offset += 8;
  const std::string_view chunk = file.substr(offset, bytes);
  offset += bytes;
  return chunk;
}

// Nothing for version 1, which another importer of Assimp reads.
std::optional<Container> open_container(std::string_view file, std::vector<std::string>& warnings) {
  using namespace std::string_view_literals;
  if (file.size() < 12) throw InputError("is cut off within the 12 bytes of a GLB header");
  const std::uint32_t version = word(file, 4), length = word(file, 8);
  if (version == 1) return std::nullopt;
  if (version != 2)
    throw InputError("is binary glTF of version " + std::to_string(version) + "; 1 and 2 are supported");
  Container container;
  std::size_t offset = 12;
  container.json = take_chunk(file, offset, "JSON"sv);
  if (offset + 8 <= std::min<std::size_t>(file.size(), length) && file.substr(offset + 4, 4) == "BIN\0"sv) {
    const std::string_view chunk = take_chunk(file, offset, "BIN\0"sv);
    container.binary = {reinterpret_cast<const std::uint8_t*>(chunk.data()), chunk.size()};
  }
  if (length != file.size())
    warnings.push_back("the GLB header says " + std::to_string(length) + " bytes and the file has " +
                       std::to_string(file.size()));
  return container;
}

std::vector<std::uint8_t> decode_base64(std::string_view text) {
  static constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::int8_t, 256> values;
  values.fill(-1);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    values[static_cast<std::uint8_t>(kAlphabet[i])] = static_cast<std::int8_t>(i);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = values[static_cast<std::uint8_t>(c)];
    if (value < 0) break;  // padding, or what is none of it: the length tells
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count & 0xFF));
  }
  return bytes;
}

std::span<const std::uint8_t> data_uri(GltfDocument& document, const std::string& uri,
                                       const std::string& where) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos)
    throw InputError(where + " has a data URI that is not base64");
  return document.decoded.emplace_back(decode_base64(std::string_view(uri).substr(comma + 1)));
}

std::span<const std::uint8_t> external(GltfDocument& document, AssetFiles& files, const std::string& uri,
                                       const std::string& where) {
  const AssetFiles::Found found = files.find(uri);
  if (found.kind == Reference::Kind::kUrl)
    throw InputError(where + " is the address \"" + uri + "\"; only files in the asset's folder are read");
  if (found.kind == Reference::Kind::kOutside)
    throw InputError(where + " is \"" + uri +
                     "\", which leads out of the asset's folder and is not followed");
  if (found.path.empty())
    throw InputError("the file \"" + uri + "\" that holds its geometry (" + where + ") is missing");
  if (!AssetFiles::readable(found.path))
    throw InputError("the file \"" + uri + "\" (" + where + ") cannot be read");
  return document.files.emplace_back(found.path).bytes();
}

// Two readers of JSON take two different ones of two members with one name. Takes valid JSON for a second
// time: json::parse with a callback walks an array's whole beginning at every object in it.
class DuplicateFinder : public nlohmann::json_sax<json> {
 public:
  bool key(string_t& name) override {
    if (open_.back().insert(name).second) return true;
    throw InputError("its JSON is ambiguous: an object has the member \"" + name.substr(0, 64) + "\" twice");
  }
  bool start_object(std::size_t /*size*/) override {
    open_.emplace_back();
    return true;
  }
  bool end_object() override {
    open_.pop_back();
    return true;
  }
  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& /*value*/) override { return true; }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_array(std::size_t /*size*/) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t /*at*/, const std::string& /*token*/,
                   const nlohmann::detail::exception& /*error*/) override {
    return false;  // the first reading has said it
  }

 private:
  std::vector<std::set<std::string>> open_;  // member names of the objects that are open
};

json parse_json(std::string_view text) {
  json root = json::parse(text);
  DuplicateFinder duplicates;
  json::sax_parse(text, &duplicates);
  return root;
}

bool is_gltf(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".gltf" || extension == ".glb";
}

bool is_version_1(const json& root) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object()) return false;
  const auto version = asset->find("version");
  return version != asset->end() && version->is_string() &&
         version->get_ref<const std::string&>().starts_with("1");
}

}  // namespace

std::optional<GltfDocument> open_gltf(const AssetFiles& files, std::vector<std::string>& warnings) {
  if (!is_gltf(files.asset_path())) return std::nullopt;
  GltfDocument document;
  const std::string_view text = document.files.emplace_back("./" + files.asset_path()).text();
  std::optional<Container> container;
  if (text.starts_with("glTF")) {
    container = open_container(text, warnings);
    if (!container) return std::nullopt;
  } else if (files.asset_path().ends_with('f') || files.asset_path().ends_with('F') ||
             text.starts_with('{')) {
    container = Container{text, std::nullopt};
  } else {
    throw InputError("is no binary glTF: it does not start with \"glTF\"");
  }
  try {
    document.root = parse_json(container->json);
  } catch (const json::exception& error) {
    const std::string_view message = error.what();  // "[json.exception.parse_error.101] parse error at ..."
    throw InputError("its JSON is broken: " +
                     std::string(message.substr(std::min(message.size(), message.find("] ") + 2))));
  }
  if (!document.root.is_object()) throw InputError("its JSON is not an object");
  if (is_version_1(document.root)) return std::nullopt;
  document.binary_chunk = container->binary;
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) document.behind_mark = text.substr(kMark.size());
  return document;
}

void load_buffers(GltfDocument& document, AssetFiles& files) {
  const json& buffers = array_of(document.root, "buffers", "the file");
  // The spans must survive the growth of their owners: MappedFile moves its pointer, a vector its heap block.
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const std::string where = "buffer " + std::to_string(i);
    const std::uint64_t bytes = whole_number(buffers[i], "byteLength", where);
    const auto uri = buffers[i].find("uri");
    std::span<const std::uint8_t> data;
    if (uri != buffers[i].end()) {
      if (!uri->is_string()) throw InputError("\"uri\" of " + where + " is not a string");
      const std::string& text = uri->get_ref<const std::string&>();
      data = text.starts_with("data:") ? data_uri(document, text, where)
                                       : external(document, files, text, where);
    } else if (i == 0 && document.binary_chunk) {
      data = *document.binary_chunk;
    } else {
      throw InputError(where + " has neither a URI nor a binary chunk");
    }
    if (data.size() < bytes)
      throw InputError(where + " promises " + std::to_string(bytes) + " bytes and holds " +
                       std::to_string(data.size()));
    document.buffers.push_back(data.first(bytes));
  }
}

std::string without_skins(const GltfDocument& document) {
  json root = document.root;
  if (root.contains("nodes"))
    for (json& node : root["nodes"])
      if (node.is_object()) node.erase("skin");
  std::string text = root.dump();
  if (!document.binary_chunk) return text;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::span<const std::uint8_t> binary = *document.binary_chunk;
  std::string file = "glTF";
  append_word(file, 2);
  append_word(file, 12 + 8 + text.size() + 8 + binary.size());
  append_word(file, text.size());
  file.append("JSON").append(text);
  append_word(file, binary.size());
  file.append("BIN\0", 4).append(reinterpret_cast<const char*>(binary.data()), binary.size());
  return file;
}

std::uint64_t whole_number(const json& object, const char* key, std::uint64_t otherwise,
                           const std::string& where) {
  if (!object.is_object()) throw InputError(where + " is not an object");
  const auto member = object.find(key);
  if (member == object.end()) return otherwise;
  const auto fail = [&] {
    return InputError("\"" + std::string(key) + "\" of " + where + " is not a whole number");
  };
  if (member->is_number_unsigned()) return member->get<std::uint64_t>();
  if (!member->is_number_float()) throw fail();
  // 36.0 is written by some exporters.
  const double value = member->get<double>();
  if (!(value >= 0 && value < 9e15) || value != static_cast<double>(static_cast<std::uint64_t>(value)))
    throw fail();
  return static_cast<std::uint64_t>(value);
}

std::uint64_t whole_number(const json& object, const char* key, const std::string& where) {
  if (!object.is_object()) throw InputError(where + " is not an object");
  if (!object.contains(key)) throw InputError(where + " has no \"" + std::string(key) + "\"");
  return whole_number(object, key, 0, where);
}

const json& array_of(const json& object, const char* key, const std::string& where) {
  static const json kEmpty = json::array();
  const auto member = object.find(key);
  if (member == object.end()) return kEmpty;
  if (!member->is_array()) throw InputError("\"" + std::string(key) + "\" of " + where + " is not an array");
  return *member;
}

}  // namespace scene_analyzer::import
