#include "import/wire.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace scene_analyzer::import::wire {
namespace {

void write_fully(int descriptor, std::span<const std::byte> bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw std::system_error(errno, std::generic_category(), "writing the imported scene");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

std::uint64_t aligned(std::uint64_t offset) {
  return (offset + kArrayAlignment - 1) / kArrayAlignment * kArrayAlignment;
}

}  // namespace

void Writer::string(std::string_view text) {
  number(static_cast<std::uint64_t>(text.size()));
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  record_.insert(record_.end(), bytes.begin(), bytes.end());
}

void Writer::begin_array() {
  end_ = aligned(end_);
  array_begin_ = end_;
}

void Writer::append_bytes(std::span<const std::byte> bytes) {
  write_fully(descriptor_, bytes, end_);
  end_ += bytes.size();
}

void Writer::end_array(std::size_t element_bytes) {
  number(array_begin_);
  number((end_ - array_begin_) / element_bytes);
}

void Writer::finish(Status status) {
  const Header header{kMagic, kVersion, static_cast<std::uint32_t>(status), aligned(end_), record_.size()};
  write_fully(descriptor_, record_, header.record_offset);
  // An empty array may stand at the very end: the memory has to reach its offset.
  const std::uint64_t total = header.record_offset + header.record_bytes;
  if (::ftruncate(descriptor_, static_cast<off_t>(total)) != 0)
    throw std::system_error(errno, std::generic_category(), "sizing the imported scene");
  write_fully(descriptor_, std::as_bytes(std::span(&header, 1)), 0);
}

bool write_header_only(int descriptor, Status status) noexcept {
  const Header header{kMagic, kVersion, static_cast<std::uint32_t>(status), sizeof(Header), 0};
  return ::pwrite(descriptor, &header, sizeof header, 0) == static_cast<ssize_t>(sizeof header);
}

Reader::Reader(std::span<const std::byte> memory) : memory_(memory) {
  Header header;
  if (memory.size() < sizeof header) throw Malformed("the answer is shorter than its header");
  std::memcpy(&header, memory.data(), sizeof header);
  if (header.magic != kMagic || header.version != kVersion) throw Malformed("the answer's header is unknown");
  if (header.status < static_cast<std::uint32_t>(Status::kScene) ||
      header.status > static_cast<std::uint32_t>(Status::kOutOfMemory))
    throw Malformed("the answer's status is unknown");
  if (header.record_offset > memory.size() || header.record_bytes > memory.size() - header.record_offset)
    throw Malformed("the answer's record lies outside of it");
  status_ = static_cast<Status>(header.status);
  record_ = memory.subspan(header.record_offset, header.record_bytes);
}

std::span<const std::byte> Reader::take(std::size_t bytes) {
  if (bytes > record_.size()) throw Malformed("the answer's record ends early");
  const auto taken = record_.first(bytes);
  record_ = record_.subspan(bytes);
  return taken;
}

std::string_view Reader::string() {
  const auto bytes = take(number<std::uint64_t>());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::size_t Reader::count(std::size_t least_bytes) {
  const auto items = number<std::uint64_t>();
  if (items > record_.size() / least_bytes) throw Malformed("the answer counts more items than it holds");
  return items;
}

std::span<const std::byte> Reader::array_bytes(std::size_t element_bytes) {
  const auto offset = number<std::uint64_t>();
  const auto elements = number<std::uint64_t>();
  if (offset % kArrayAlignment != 0 || offset > memory_.size() ||
      elements > (memory_.size() - offset) / element_bytes)
    throw Malformed("an array of the answer lies outside of it");
  return memory_.subspan(offset, elements * element_bytes);
}

}  // namespace scene_analyzer::import::wire
