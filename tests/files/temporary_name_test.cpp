#include "files/temporary_name.h"

#include <gtest/gtest.h>

#include <set>

namespace scene_analyzer::files {
namespace {

TEST(TemporaryName, IsNewEveryTimeAndRecognised) {
  std::set<std::string> names;
  for (int i = 0; i < 1000; ++i) {
    names.insert(temporary_name());
    EXPECT_TRUE(is_temporary_name(*names.rbegin())) << *names.rbegin();
  }
  EXPECT_EQ(names.size(), 1000U);
}

TEST(TemporaryName, IsHiddenShortAndOneComponent) {
  const std::string name = temporary_name();
  EXPECT_TRUE(name.starts_with('.'));
  EXPECT_LE(name.size(), 64U);
  EXPECT_EQ(name.find('/'), std::string::npos);
}

TEST(TemporaryName, OtherNamesAreNotTaken) {
  const std::string name = temporary_name();
  std::string letter = name, capital = name;
  letter[20] = 'g';
  capital[20] = 'A';
  for (const std::string& other :
       {std::string(), std::string("room.obj"), std::string(".scene-analyzer-.tmp"), letter, capital,
        name.substr(1), name + "x", name.substr(0, name.size() - 1), "x" + name.substr(1),
        std::string(".scene-analyzer-notes.tmp")})
    EXPECT_FALSE(is_temporary_name(other)) << other;
}

}  // namespace
}  // namespace scene_analyzer::files
