// token_list.h — Who may ask: bearer tokens, one per line of a file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string_view>
#include <vector>

namespace scene_analyzer::service {

inline constexpr std::size_t kShortestToken = 16;  // characters

class TokenList {
 public:
  // One token per line, at least 16 printable characters without spaces; empty lines and those that begin
  // with # do not count. Throws InputError when the file cannot be read or holds no such token or anything
  // else.
  explicit TokenList(std::filesystem::path file);

  // Reads the file again. Throws InputError; the tokens stay as they were then.
  void reload();

  // Whether `authorization` is "Bearer " and a token of the file. How long that takes does not depend on how
  // much of a token is right: hashes are compared, with all tokens, in constant time.
  bool accepts(std::string_view authorization) const;

 private:
  using Digest = std::array<std::uint8_t, 32>;  // SHA-256
  static Digest digest(std::string_view token);
  std::vector<Digest> read() const;

  const std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::vector<Digest> digests_;
};

}  // namespace scene_analyzer::service
