#include "import/worker_binary.h"

#include <sys/stat.h>

#include "files/helper_program.h"
#include "import/import.h"

namespace scene_analyzer::import {
namespace {

constexpr const char* kWorkerProgram = "scene-analyzer-import";

struct Found {
  std::string path = files::helper_program(kWorkerProgram).string();
  struct stat state = {};
  bool is_there = !path.empty() && ::stat(path.c_str(), &state) == 0;
};

const Found& first_look() {
  static const Found found;
  return found;
}

bool is_same(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
         a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

}  // namespace

void find_worker() {
  first_look();
}

std::string worker_program() {
  const Found& found = first_look();
  struct stat now = {};
  const bool unchanged = found.is_there && ::stat(found.path.c_str(), &now) == 0 && is_same(now, found.state);
  return unchanged ? found.path : "/proc/self/exe";
}

}  // namespace scene_analyzer::import
