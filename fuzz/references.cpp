// Names that assets give for other files, and text of assets that people get to see: no name leads out of the
// folder, no text drives a terminal or is no UTF-8.
#include <nlohmann/json.hpp>

#include "import/asset_files.h"
#include "import/text.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  return {"wood.png",        "sub/wood.png",     "../outside.mtl",         "..\\..\\etc\\passwd",
          "/etc/passwd",     "C:\\secret.txt",   "file:///etc/passwd",     "http://x.org/a",
          "%2e%2e/%2e%2e/x", "a/../../b",        "%2Fetc/passwd",          "a//./b/../../../c/d",
          "\\\\server\\s.x", "St\xC3\xBChl.png", "\x1b[31mred\xE2\x80\xAE"};
}

namespace {

void check_reference(const import::Reference& reference) {
  if (reference.kind != import::Reference::Kind::kInside) return;
  const std::filesystem::path path = reference.path;
  require(path.is_relative(), "a path inside is relative");
  for (const std::filesystem::path& part : path) require(part != "..", "a path inside goes nowhere up");
}

void check_clean(const std::string& text, std::size_t longest) {
  require(text.size() <= longest, "text has an end");
  for (const char c : text)
    require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "text has no controls");
  nlohmann::json(text).dump();  // throws where it is not UTF-8
  require(import::clean_text(text, longest) == text, "clean text stays as it is");
}

}  // namespace
}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  const std::string_view text = fuzz::text_of(data, size);
  for (const char* folder : {"/", "/assets/room"}) {
    fuzz::check_reference(import::resolve_reference(folder, text));
    fuzz::check_reference(import::resolve_reference(folder, import::decode_percent(text)));
  }
  for (const std::size_t longest : {std::size_t{3}, std::size_t{32}, std::size_t{4096}})
    fuzz::check_clean(import::clean_text(text, longest), longest);
  return 0;
}
