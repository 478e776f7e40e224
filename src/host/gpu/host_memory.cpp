#include "gpu/host_memory.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace scene_analyzer::gpu {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::optional<std::uint64_t> number_after(const std::string& text, const std::string& key) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::uint64_t value = 0;
    if (words >> name >> value && name == key) return value;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> number_in(const fs::path& path) {
  std::istringstream text(read_text(path));
  std::uint64_t value = 0;
  if (text >> value) return value;
  return std::nullopt;  // no such file, or the word "max"
}

// What a version 2 control group leaves. File cache that can be dropped counts as free.
std::optional<std::uint64_t> free_in_group(const fs::path& folder) {
  const auto limit = number_in(folder / "memory.max");
  const auto used = number_in(folder / "memory.current");
  if (!limit || !used) return std::nullopt;
  const std::uint64_t droppable =
      number_after(read_text(folder / "memory.stat"), "inactive_file").value_or(0);
  const std::uint64_t held = *used - std::min(*used, droppable);
  return *limit - std::min(*limit, held);
}

void keep_smaller(std::optional<std::uint64_t>& least, std::optional<std::uint64_t> value) {
  if (value && (!least || *value < *least)) least = value;
}

}  // namespace

std::optional<std::uint64_t> available_bytes_of_meminfo(const std::string& text) {
  const auto kibibytes = number_after(text, "MemAvailable:");
  if (!kibibytes) return std::nullopt;
  return *kibibytes * 1024;
}

std::optional<std::uint64_t> free_host_memory_bytes() {
  std::optional<std::uint64_t> least = available_bytes_of_meminfo(read_text("/proc/meminfo"));
  // "0::/path" names this process's group; every ancestor may have a limit of its own.
  std::istringstream groups(read_text("/proc/self/cgroup"));
  const fs::path root = "/sys/fs/cgroup";
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::/")) continue;
    fs::path below = fs::path(line.substr(4)).lexically_normal();
    for (; !below.empty() && below != "."; below = below.parent_path())
      keep_smaller(least, free_in_group(root / below));
  }
  keep_smaller(least, free_in_group(root));
  return least;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

}  // namespace scene_analyzer::gpu
