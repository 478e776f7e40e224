#include "report/terminal_text.h"

#include <gtest/gtest.h>

#include <random>

namespace scene_analyzer::report {
namespace {

std::size_t width(std::string_view text) {
  const UnicodeScope unicode;
  return columns(printable(text));
}

std::string shown(std::string_view text) {
  const UnicodeScope unicode;
  return encode_utf8(printable(text));
}

std::string cut(std::string_view text, std::size_t to) {
  const UnicodeScope unicode;
  return encode_utf8(shortened(printable(text), to));
}

TEST(Utf8, RoundTripsWellFormedText) {
  const std::string text = "a\u00e4\u6f22\U0001F642\U0010FFFF";
  EXPECT_EQ(decode_utf8(text), U"a\u00e4\u6f22\U0001F642\U0010FFFF");
  EXPECT_EQ(valid_utf8(text), text);
}

TEST(Utf8, ReplacesMalformedBytes) {
  EXPECT_EQ(decode_utf8("a\xff"
                        "b"),
            U"a\uFFFDb");
  EXPECT_EQ(decode_utf8("\xc3"), U"\uFFFD");  // cut off
  EXPECT_EQ(decode_utf8("\xe6\xbcx"), U"\uFFFD\uFFFDx");
  EXPECT_EQ(decode_utf8("\xc0\xaf"), U"\uFFFD\uFFFD");  // overlong
  EXPECT_EQ(decode_utf8("\xe0\x80\xaf"), U"\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(decode_utf8("\xed\xa0\x80"), U"\uFFFD\uFFFD\uFFFD");  // surrogate
  EXPECT_EQ(decode_utf8("\xf4\x90\x80\x80").size(), 4u);          // beyond U+10FFFF
}

TEST(Utf8, NeverProducesMalformedText) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes(random() % 40, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    const std::string once = valid_utf8(bytes);
    EXPECT_EQ(valid_utf8(once), once);
  }
}

TEST(Columns, KnowWideAndCombiningCharacters) {
  EXPECT_EQ(width("table"), 5u);
  EXPECT_EQ(width("T\u00fcr"), 3u);
  EXPECT_EQ(width("\u6f22\u5b57"), 4u);
  EXPECT_EQ(width("e\u0301"), 1u);
  EXPECT_EQ(width("\U0001F642"), 2u);
}

TEST(Printable, LetsNoControlThrough) {
  EXPECT_EQ(shown("a\x1b[31mb"), "a\uFFFD[31mb");
  EXPECT_EQ(shown("a\tb\nc\rd\x7f"), "a\uFFFDb\uFFFDc\uFFFDd\uFFFD");
  EXPECT_EQ(shown(std::string_view("a\0b", 3)), "a\uFFFDb");
  EXPECT_EQ(shown("\u009b31m"), "\uFFFD31m");            // the one-character form of ESC [
  EXPECT_EQ(shown("a\u202egpj.exe"), "a\uFFFDgpj.exe");  // right-to-left override
  EXPECT_EQ(shown("a\u2028b\u200b\ufeff"), "a\uFFFDb\uFFFD\uFFFD");
  for (int byte = 0; byte < 256; ++byte)
    for (const char c : shown(std::string(1, static_cast<char>(byte))))
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << byte;
}

TEST(Shortened, KeepsBothEnds) {
  EXPECT_EQ(cut("leg", 3), "leg");
  EXPECT_EQ(cut("couch leg left", 8), "couc\u2026eft");
  EXPECT_EQ(cut("couch leg left", 1), "\u2026");
  EXPECT_EQ(cut("couch leg left", 2), "c\u2026");
}

TEST(Shortened, NeverExceedsTheWidth) {
  const UnicodeScope unicode;
  const std::u32string text = printable("\u6f22e\u0301\u5b57-T\u00fcr-\U0001F642-\u6f22\u0301x");
  for (std::size_t to = 1; to < 20; ++to) {
    const std::u32string fitting = shortened(text, to);
    EXPECT_LE(columns(fitting), to);
    EXPECT_EQ(fitting == text, columns(text) <= to);
  }
}

}  // namespace
}  // namespace scene_analyzer::report
