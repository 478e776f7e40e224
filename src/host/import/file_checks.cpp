#include "import/file_checks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "import/mapped_file.h"
#include "import/obj_check.h"
#include "import/ply_check.h"
#include "import/text.h"

namespace scene_analyzer::import {
namespace {

using namespace std::string_view_literals;

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string extension_of(const std::string& asset) {
  return lower(std::filesystem::path(asset).extension().string());
}

struct Imposter {
  std::string_view start;
  std::string_view what;
};
constexpr std::array kImposters = {
    Imposter{"\x89PNG\r\n"sv, "a PNG image"},
    Imposter{"\xFF\xD8\xFF"sv, "a JPEG image"},
    Imposter{"GIF8"sv, "a GIF image"},
    Imposter{"%PDF"sv, "a PDF document"},
    Imposter{"\x1F\x8B"sv, "gzip-compressed data; unpack it first"},
    Imposter{"Rar!"sv, "a RAR archive; unpack it first"},
    Imposter{"7z\xBC\xAF"sv, "a 7z archive; unpack it first"},
};
constexpr std::array kTextFormats = {".obj"sv, ".ply"sv, ".off"sv, ".stl"sv, ".gltf"sv};

bool is_utf16(std::string_view contents) {
  return contents.starts_with("\xFF\xFE"sv) || contents.starts_with("\xFE\xFF"sv);
}

void check_start(std::string_view contents, const std::string& extension) {
  if (contents.starts_with("version https://git-lfs.github.com/spec/"))
    throw InputError("is a Git LFS pointer, not the asset itself; fetch it with `git lfs pull`");
  const std::string start = lower(contents.substr(0, 256));
  const std::size_t text = start.find_first_not_of(" \t\r\n");
  const std::string_view markup = text == std::string::npos ? ""sv : std::string_view(start).substr(text);
  if (markup.starts_with("<!doctype html") || markup.starts_with("<html"))
    throw InputError("holds a web page, not an asset; the download has probably failed");
  // Blender compresses its own files with gzip.
  for (const Imposter& imposter : kImposters)
    if (contents.starts_with(imposter.start) && extension != ".blend")
      throw InputError("holds " + std::string(imposter.what));
  if (contents.starts_with("glTF\2"sv) && extension != ".glb" && extension != ".gltf")
    throw InputError("holds binary glTF; rename it to .glb");
  if (is_utf16(contents) &&
      std::find(kTextFormats.begin(), kTextFormats.end(), extension) != kTextFormats.end())
    throw InputError("is UTF-16 text, which this format does not allow; convert it to UTF-8");
}

void check_stl(std::string_view contents) {
  constexpr std::uint64_t kHeader = 84, kTriangle = 50;
  std::uint32_t triangles = 0;
  if (contents.size() >= kHeader)
    std::memcpy(&triangles, contents.data() + kHeader - sizeof triangles, sizeof triangles);
  const std::uint64_t expected = kHeader + kTriangle * triangles;
  const bool is_binary = contents.size() >= kHeader && contents.size() == expected;
  const std::size_t first = contents.find_first_not_of(" \t\r\n");
  // Binary headers may start with "solid" too, but text has no zero bytes.
  const bool is_text = contents.substr(0, 4096).find('\0') == std::string_view::npos &&
                       first != std::string_view::npos && lower(contents.substr(first, 5)) == "solid";
  if (is_binary && triangles > 0) return;
  if (is_binary) throw InputError("is a binary STL of 0 triangles");
  if (is_text) return;
  throw InputError("is no whole STL: a binary one of " + std::to_string(triangles) + " triangles takes " +
                   std::to_string(expected) + " bytes and the file has " + std::to_string(contents.size()) +
                   "; a text one starts with \"solid\" and has no zero bytes");
}

// Formats that say where they end, and of which Assimp takes any part without a word.
struct Ending {
  std::string_view extension;
  std::string_view last_words;  // lower case, somewhere in the last bytes
};
constexpr std::array kEndings = {Ending{".stl", "endsolid"}, Ending{".dxf", "eof"}, Ending{".smd", "end"},
                                 Ending{".x3d", "</x3d"}};
constexpr std::size_t kLastBytes = 512;
constexpr std::size_t kLongestMessage = 300;

void check_ending(std::string_view contents, const std::string& extension,
                  std::vector<std::string>& warnings) {
  const std::string_view last = contents.substr(contents.size() - std::min(contents.size(), kLastBytes));
  if (last.find('\0') != std::string_view::npos) return;  // the binary kind of the format
  for (const Ending& ending : kEndings)
    if (extension == ending.extension && lower(last).find(ending.last_words) == std::string::npos)
      warnings.push_back("its text does not end with \"" + std::string(ending.last_words) +
                         "\": the file may be cut off");
}

}  // namespace

void check_file(const std::string& asset, std::vector<std::string>& warnings) {
  const MappedFile file("./" + asset);
  const std::string extension = extension_of(asset);
  check_start(file.text(), extension);
  if (extension == ".stl") check_stl(file.text());
  if (extension == ".ply") check_ply(file.text());
  check_ending(file.text(), extension, warnings);
}

std::string replacement_for(const std::string& asset) {
  return extension_of(asset) == ".obj" ? without_indentation(MappedFile("./" + asset).text()) : std::string();
}

void require_content(const std::string& asset, std::size_t meshes, std::uint64_t triangles,
                     std::vector<std::string>& warnings) {
  const std::string extension = extension_of(asset);
  if (extension == ".3mf" && meshes == 0)
    throw InputError("holds no object that Assimp can read; 3MF's production extension is not supported");
  if (extension != ".obj") return;
  const std::uint64_t faces = count_obj_faces(MappedFile("./" + asset).text());
  if (triangles >= faces) return;
  const std::string counts = "Assimp reads " + std::to_string(triangles) + " triangles of a file with " +
                             std::to_string(faces) + " faces";
  if (triangles == 0)
    throw InputError(counts + "; do its faces name texture coordinates or normals that it does not hold?");
  warnings.push_back(counts + "; the others are left out, probably because their corners are damaged");
}

std::string explain_failure(const std::string& assimp_message, const std::string& asset) {
  if (is_utf16(MappedFile("./" + asset).text()))
    return "is UTF-16 text, which Assimp does not read in this format; convert it to UTF-8";
  if (assimp_message.starts_with("No suitable reader found")) {
    if (extension_of(asset).empty()) return "has no extension and its contents are in no known format";
    return "its contents are not in the format that \"" + extension_of(asset) + "\" stands for";
  }
  if (assimp_message.empty()) return "Assimp cannot read it and gives no reason";
  // It may quote the rest of the file.
  std::string line = assimp_message;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  const std::string reason = "Assimp cannot read it: " + clean_text(line, kLongestMessage);
  if (assimp_message.find("Invalid accessor without data") != std::string::npos)
    return reason + "; if its geometry is compressed, export it without compression";
  return reason;
}

}  // namespace scene_analyzer::import
