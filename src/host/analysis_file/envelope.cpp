#include "analysis_file/envelope.h"

#include "analysis_file/hash.h"
#include "analysis_file/little_endian.h"

namespace scene_analyzer::analysis_file {
namespace {

constexpr std::size_t kVersionOffset = 8;
constexpr std::size_t kReservedOffset = 12;
constexpr std::size_t kSizeOffset = 16;

Unusable because(std::string reason) {
  return {false, std::move(reason)};
}

}  // namespace

std::string seal(std::string_view payload, std::uint32_t format_version) {
  std::string bytes;
  bytes.reserve(kHeaderBytes + payload.size() + kChecksumBytes);
  bytes += kMagic;
  append(bytes, format_version);
  append(bytes, std::uint32_t{0});
  append(bytes, static_cast<std::uint64_t>(payload.size()));
  bytes += payload;
  const Hash hash = hash_of(bytes);
  append(bytes, hash[0]);
  append(bytes, hash[1]);
  return bytes;
}

std::variant<std::string_view, Unusable> unseal(std::string_view bytes) {
  if (bytes.empty()) return because("is empty");
  if (bytes.substr(0, kMagic.size()) != kMagic.substr(0, bytes.size()))
    return because("is not an analysis file");
  if (bytes.size() < kHeaderBytes + kChecksumBytes)
    return because("is truncated: " + std::to_string(bytes.size()) + " bytes");

  const std::size_t signed_bytes = bytes.size() - kChecksumBytes;
  const auto declared = read_at<std::uint64_t>(bytes, kSizeOffset);
  const std::uint64_t present = signed_bytes - kHeaderBytes;
  if (declared > present)
    return because("is truncated: " + std::to_string(present) + " of " + std::to_string(declared) +
                   " bytes of payload");
  const Hash stored = {read_at<std::uint64_t>(bytes, signed_bytes),
                       read_at<std::uint64_t>(bytes, signed_bytes + 8)};
  if (declared < present || hash_of(bytes.substr(0, signed_bytes)) != stored)
    return because("is corrupt: its checksum does not match");

  const auto version = read_at<std::uint32_t>(bytes, kVersionOffset);
  if (version > kFormatVersion)
    return because("was written by a newer version of the program (format " + std::to_string(version) +
                   ", this one reads " + std::to_string(kFormatVersion) + ")");
  if (version != kFormatVersion || read_at<std::uint32_t>(bytes, kReservedOffset) != 0)
    return because("has an unknown format version (" + std::to_string(version) + ")");
  return bytes.substr(kHeaderBytes, present);
}

}  // namespace scene_analyzer::analysis_file
