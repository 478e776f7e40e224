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

// One line each: a digit and the line's end are the least that a value takes.
void check_text(const Header& header, std::string_view data) {
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    const std::uint64_t least = 2 * element.properties.size();
    const std::uint64_t room = (data.size() + 1) / least;
    if (element.count > room) throw_short(element, room);
    data.remove_prefix(std::min<std::uint64_t>(data.size(), element.count * least));
  }
}

}  // namespace

void check_ply(std::string_view contents) {
  const std::optional<Header> header = read_header(contents);
  if (!header) return;
  const std::string_view data = contents.substr(header->bytes);
  if (header->format == Header::Format::kText)
    check_text(*header, data);
  else
    check_binary(*header, data);
}

}  // namespace scene_analyzer::import
