#include "import/ply_check.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"

namespace scene_analyzer::import {
namespace {

struct Property {
  std::size_t bytes = 0;        // of the value, or of each item of a list
  std::size_t count_bytes = 0;  // of a list's length; 0: not a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has_lists() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const Property& p) { return p.count_bytes > 0; });
  }
  std::uint64_t least_bytes() const {
    std::uint64_t bytes = 0;
    for (const Property& property : properties)
      bytes += property.count_bytes > 0 ? property.count_bytes : property.bytes;
    return bytes;
  }
};

struct Header {
  enum class Format { kText, kLittleEndian, kBigEndian };
  Format format = Format::kText;
  std::vector<Element> elements;
  std::size_t bytes = 0;
};

std::size_t size_of(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "int32" || type == "uint32" || type == "float" ||
      type == "float32")
    return 4;
  return type == "double" || type == "float64" ? 8 : 0;
}

// False when the line is not understood.
bool read_line(const std::string& line, Header& header) {
  std::istringstream words(line);
  std::string keyword, type, second;
  words >> keyword;
  if (keyword == "format") {
    words >> type;
    header.format = type == "ascii"                  ? Header::Format::kText
                    : type == "binary_little_endian" ? Header::Format::kLittleEndian
                                                     : Header::Format::kBigEndian;
  } else if (keyword == "element") {
    Element& element = header.elements.emplace_back();
    return static_cast<bool>(words >> element.name >> element.count);
  } else if (keyword == "property") {
    if (header.elements.empty()) return false;
    Property property;
    words >> type;
    if (type == "list") {
      words >> second >> type;
      property.count_bytes = size_of(second);
      if (property.count_bytes == 0 || property.count_bytes > 4) return false;
    }
    property.bytes = size_of(type);
    header.elements.back().properties.push_back(property);
    return property.bytes > 0;
  }
  return true;
}

std::optional<Header> read_header(std::string_view contents) {
  Header header;
  std::size_t position = 0;
  while (position < contents.size()) {
    const std::size_t end = contents.find('\n', position);
    if (end == std::string_view::npos || end - position > 4096) return std::nullopt;
    std::string line(contents.substr(position, end - position));
    if (line.ends_with('\r')) line.pop_back();
    position = end + 1;
    if (line == "end_header") {
      header.bytes = position;
      return header;
    }
    if (!read_line(line, header)) return std::nullopt;
  }
  return std::nullopt;
}

std::uint64_t list_length(const char* at, std::size_t bytes, bool big_endian) {
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    length = length << 8 | static_cast<std::uint8_t>(at[big_endian ? i : bytes - 1 - i]);
  return length;
}

[[noreturn]] void throw_short(const Element& element, std::uint64_t held) {
  throw InputError("is cut off: its header counts " + std::to_string(element.count) + " of \"" +
                   element.name + "\" but the data ends " +
                   (held == 0 ? "before the first" : "after " + std::to_string(held)));
}

// Bytes that the elements with lists take; `data` starts at the first.
std::size_t walk_lists(const Element& element, std::string_view data, bool big_endian) {
  std::size_t position = 0;
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) {
      std::uint64_t bytes = property.bytes;
      if (property.count_bytes > 0) {
        if (property.count_bytes > data.size() - position) throw_short(element, i);
        bytes *= list_length(data.data() + position, property.count_bytes, big_endian);
        position += property.count_bytes;
      }
      if (bytes > data.size() - position) throw_short(element, i);
      position += bytes;
    }
  return position;
}

void check_binary(const Header& header, std::string_view data) {
  for (const Element& element : header.elements) {
    const std::uint64_t least = element.least_bytes();
    if (least == 0) continue;
    if (element.count > data.size() / least) throw_short(element, data.size() / least);
    data.remove_prefix(element.has_lists()
                           ? walk_lists(element, data, header.format == Header::Format::kBigEndian)
                           : element.count * least);
  }
}

// Words of a text, one after the other.
class Words {
 public:
  explicit Words(std::string_view text) : left_(text) {}

  // Nothing at the end.
  std::optional<std::string_view> next() {
    constexpr std::string_view kBetweenWords = " \t\r\n";
    const std::size_t first = left_.find_first_not_of(kBetweenWords);
    if (first == std::string_view::npos) return std::nullopt;
    left_.remove_prefix(first);
    const std::string_view word = left_.substr(0, left_.find_first_of(kBetweenWords));
    left_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view left_;
};

bool skip_element(const Element& element, Words& words) {
  for (const Property& property : element.properties) {
    const std::optional<std::string_view> word = words.next();
    if (!word) return false;
    if (property.count_bytes == 0) continue;
    std::uint64_t length = 0;
    std::from_chars(word->data(), word->data() + word->size(), length);
    for (; length > 0; --length)
      if (!words.next()) return false;
  }
  return true;
}

// An element stands on a line of its own, so that lines can be counted and only a file with too few is read
// word by word.
void check_text(const Header& header, std::string_view data) {
  const auto ends = static_cast<std::uint64_t>(std::count(data.begin(), data.end(), '\n'));
  const std::uint64_t lines = ends + (data.empty() || data.back() == '\n' ? 0 : 1);
  std::uint64_t counted = 0;
  bool enough = true;
  for (const Element& element : header.elements) {
    enough = enough && element.count <= lines - counted;
    if (enough) counted += element.count;
  }
  if (enough) return;
  Words words(data);
  for (const Element& element : header.elements)
    for (std::uint64_t i = 0; i < (element.properties.empty() ? 0 : element.count); ++i)
      if (!skip_element(element, words)) throw_short(element, i);
}

}  // namespace

void check_ply(std::string_view contents) {
  // Assimp waits for the end of a header until its time is up.
  if (contents.find("end_header") == std::string_view::npos)
    throw InputError("is cut off: its header has no end");
  const std::optional<Header> header = read_header(contents);
  if (!header) return;
  const std::string_view data = contents.substr(header->bytes);
  if (header->format == Header::Format::kText)
    check_text(*header, data);
  else
    check_binary(*header, data);
}

}  // namespace scene_analyzer::import
