// wire.h — The worker's answer as bytes in shared memory: header, arrays, then the record that describes
// them.
//
//   Header | arrays, each aligned to 64 bytes | record (numbers, strings and references to arrays)
//
// Both ends are the same program on the same machine, so numbers are native. The worker streams arrays as it
// goes; the reader trusts nothing: every offset, count and length is checked against the size of the memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace scene_analyzer::import::wire {

inline constexpr std::array<char, 8> kMagic = {'S', 'C', 'N', 'I', 'M', 'P', 'R', 'T'};
inline constexpr std::uint32_t kVersion = 2;
inline constexpr std::uint64_t kArrayAlignment = 64;

enum class Status : std::uint32_t {
  kScene = 1,        // record: a scene
  kRefused = 2,      // record: one string, the reason
  kOutOfMemory = 3,  // record: empty
};

struct Header {
  std::array<char, 8> magic{};
  std::uint32_t version = 0;
  std::uint32_t status = 0;
  std::uint64_t record_offset = 0;
  std::uint64_t record_bytes = 0;
};

// The memory does not hold what a worker would write.
class Malformed : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Writes to a file descriptor, which it does not own. Throws std::system_error when the system refuses to.
class Writer {
 public:
  explicit Writer(int descriptor) : descriptor_(descriptor) {}

  template <typename T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    record_.insert(record_.end(), bytes, bytes + sizeof(T));
  }
  void string(std::string_view text);

  // An array goes out in pieces: begin_array, append..., end_array, which puts its reference into the record.
  void begin_array();
  template <typename T>
  void append(std::span<const T> values) {
    append_bytes(std::as_bytes(values));
  }
  void end_array(std::size_t element_bytes);

  // The record and the header; nothing counts before this.
  void finish(Status status);

 private:
  void append_bytes(std::span<const std::byte> bytes);

  int descriptor_;
  std::uint64_t end_ = sizeof(Header);
  std::uint64_t array_begin_ = 0;
  std::vector<std::byte> record_;
};

// A header alone, without allocating: for reporting that memory has run out. Returns false when even that
// fails.
bool write_header_only(int descriptor, Status status) noexcept;

// Reads what a Writer wrote; `memory` must outlive the spans it hands out. Throws Malformed.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> memory);

  Status status() const { return status_; }

  template <typename T>
  T number() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string_view string();

  // How many items follow, of which each takes at least `least_bytes` of the record: a lying count cannot
  // make the caller reserve more than the memory it was handed.
  std::size_t count(std::size_t least_bytes);

  template <typename T>
  std::span<const T> array() {
    const std::span<const std::byte> bytes = array_bytes(sizeof(T));
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

 private:
  std::span<const std::byte> take(std::size_t bytes);
  std::span<const std::byte> array_bytes(std::size_t element_bytes);

  std::span<const std::byte> memory_;
  std::span<const std::byte> record_;
  Status status_ = Status::kRefused;
};

}  // namespace scene_analyzer::import::wire
