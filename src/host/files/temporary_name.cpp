#include "files/temporary_name.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>

namespace scene_analyzer::files {
namespace {

constexpr std::string_view kPrefix = ".scene-analyzer-";
constexpr std::string_view kSuffix = ".tmp";
constexpr std::string_view kDigits = "0123456789abcdef";
constexpr std::size_t kRandomBytes = 16;

}  // namespace

std::string temporary_name() {
  std::array<unsigned char, kRandomBytes> noise{};
  if (::getentropy(noise.data(), noise.size()) != 0) throw std::system_error(errno, std::generic_category());
  std::string name(kPrefix);
  for (const unsigned char byte : noise) {
    name += kDigits[byte >> 4];
    name += kDigits[byte & 15];
  }
  name += kSuffix;
  return name;
}

bool is_temporary_name(std::string_view name) {
  if (name.size() != kPrefix.size() + 2 * kRandomBytes + kSuffix.size()) return false;
  return name.starts_with(kPrefix) && name.ends_with(kSuffix) &&
         name.substr(kPrefix.size(), 2 * kRandomBytes).find_first_not_of(kDigits) == std::string_view::npos;
}

}  // namespace scene_analyzer::files
