#include "service/token_list.h"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <algorithm>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "files/file.h"

namespace scene_analyzer::service {
namespace {

constexpr std::uint64_t kLargestFile = 1 << 20;

std::string read_file(const std::filesystem::path& path) {
  try {
    files::File file = files::File::open_regular(path);
    if (file.size() > kLargestFile)
      throw InputError(fmt::format("{}: is too large for a list of tokens", path.string()));
    std::string text(static_cast<std::size_t>(file.size()), '\0');
    text.resize(file.read(text));
    return text;
  } catch (const std::system_error& error) {
    throw InputError(fmt::format("{}: cannot be read: {}", path.string(), files::describe(error.code())));
  }
}

}  // namespace

TokenList::TokenList(std::filesystem::path file) : file_(std::move(file)), digests_(read()) {}

void TokenList::reload() {
  std::vector<Digest> digests = read();
  const std::lock_guard lock(mutex_);
  digests_ = std::move(digests);
}

std::vector<TokenList::Digest> TokenList::read() const {
  const std::string text = read_file(file_);
  std::vector<Digest> digests;
  std::size_t number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.starts_with('#')) continue;
    if (line.size() < kShortestToken || std::ranges::any_of(line, [](char c) { return c <= ' ' || c > '~'; }))
      throw InputError(
          fmt::format("{}:{}: is no token: at least {} printable characters without spaces, as 'openssl "
                      "rand -hex 32' makes them",
                      file_.string(), number, kShortestToken));
    digests.push_back(digest(line));
  }
  if (digests.empty())
    throw InputError(fmt::format(
        "{}: holds no token; write one per line, for example with 'openssl rand -hex 32'", file_.string()));
  return digests;
}

TokenList::Digest TokenList::digest(std::string_view token) {
  Digest result{};
  if (EVP_Digest(token.data(), token.size(), result.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw std::bad_alloc();
  return result;
}

bool TokenList::accepts(std::string_view authorization) const {
  constexpr std::string_view kScheme = "Bearer ";
  if (!authorization.starts_with(kScheme)) return false;
  const Digest given = digest(authorization.substr(kScheme.size()));
  const std::lock_guard lock(mutex_);
  int accepted = 0;
  for (const Digest& known : digests_)
    accepted |= static_cast<int>(CRYPTO_memcmp(known.data(), given.data(), known.size()) == 0);
  return accepted != 0;
}

}  // namespace scene_analyzer::service
