#include <gtest/gtest.h>

#include "import/text.h"

namespace scene_analyzer::import {
namespace {

TEST(CleanText, KeepsWhatIsFine) {
  EXPECT_EQ(clean_text("Stuhl äöü €  \xF0\x9F\xAA\x91"), "Stuhl äöü €  \xF0\x9F\xAA\x91");
  EXPECT_EQ(clean_text(""), "");
}

TEST(CleanText, DropsControlsAndReorderingMarks) {
  EXPECT_EQ(clean_text(std::string_view("a\0b\n\r\t\x1b[31mc\x7f", 14)), "ab[31mc");
  EXPECT_EQ(clean_text("a\xC2\x85"
                       "b\xE2\x80\xAE"
                       "c\xE2\x80\xA8"
                       "d\xE2\x81\xA6"
                       "e"),
            "abcde");
}

TEST(CleanText, ReplacesBrokenUtf8) {
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(clean_text("\xFF"), mark);
  EXPECT_EQ(clean_text("a\xC3"), "a" + mark);                            // cut off
  EXPECT_EQ(clean_text("\xC0\x80"), mark + mark);                        // overlong
  EXPECT_EQ(clean_text("\xED\xA0\x80"), mark + mark + mark);             // surrogate
  EXPECT_EQ(clean_text("\xF4\x90\x80\x80"), mark + mark + mark + mark);  // beyond Unicode
  EXPECT_EQ(clean_text("\xE2\x28\xA1"), mark + "(" + mark);
}

TEST(CleanText, CutsBetweenCharacters) {
  EXPECT_EQ(clean_text("abcdef", 6), "abcdef");
  EXPECT_EQ(clean_text("abcdefg", 6), "abc...");
  EXPECT_EQ(clean_text("aäääää", 7), "a\xC3\xA4...");  // six bytes: a seventh would be half a character
  const std::string huge(1 << 20, 'x');
  EXPECT_EQ(clean_text(huge).size(), kLongestName);
}

}  // namespace
}  // namespace scene_analyzer::import
