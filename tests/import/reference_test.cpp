#include <gtest/gtest.h>

#include "import/asset_files.h"

namespace scene_analyzer::import {
namespace {

using Kind = Reference::Kind;

TEST(Reference, StaysInside) {
  for (const auto& [text, path] : {std::pair{"a.bin", "a.bin"},
                                   {"sub/a.bin", "sub/a.bin"},
                                   {"./a.bin", "a.bin"},
                                   {"sub/../a.bin", "a.bin"},
                                   {"../box/a.bin", "a.bin"},
                                   {"sub\\a.bin", "sub/a.bin"},
                                   {"a..b/c", "a..b/c"},
                                   {"...", "..."}}) {
    const Reference reference = resolve_reference("/models/box", text);
    EXPECT_EQ(reference.kind, Kind::kInside) << text;
    EXPECT_EQ(reference.path, path) << text;
  }
}

TEST(Reference, LeadsOut) {
  for (const char* text : {"../a.bin", "/etc/passwd", "\\\\server\\share", "C:\\a.png", "c:a.png",
                           "sub/../../a.bin", "..", "..\\a.bin", "../box2/a.bin", "../../models/boxes/a.bin"})
    EXPECT_EQ(resolve_reference("/models/box", text).kind, Kind::kOutside) << text;
}

TEST(Reference, IsAnAddress) {
  for (const char* text : {"http://host/a.bin", "https://host", "file:///etc/passwd", "FTP://x"})
    EXPECT_EQ(resolve_reference("/models/box", text).kind, Kind::kUrl) << text;
}

TEST(Reference, PercentEscapes) {
  EXPECT_EQ(decode_percent("a%20b"), "a b");
  EXPECT_EQ(decode_percent("%2e%2E/x"), "../x");
  EXPECT_EQ(decode_percent("100%"), "100%");
  EXPECT_EQ(decode_percent("%4"), "%4");
  EXPECT_EQ(decode_percent("%zz%41"), "%zzA");
}

}  // namespace
}  // namespace scene_analyzer::import
