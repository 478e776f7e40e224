#include "import/import.h"
#include <gtest/gtest.h>
TEST(Import, X) {
  auto s = scene_analyzer::import::import_asset(std::getenv("A"));
  printf("%zu %s\n", s.meshes.size(), s.format.c_str());
}
