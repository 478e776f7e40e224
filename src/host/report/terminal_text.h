// terminal_text.h — Text from files made fit for a terminal: valid UTF-8, no control of any kind, measured in
// columns.
#pragma once

#include <clocale>
#include <cstddef>
#include <string>
#include <string_view>

namespace scene_analyzer::report {

// Every byte that is not part of well-formed UTF-8 (overlong forms and surrogates are not) becomes U+FFFD.
std::u32string decode_utf8(std::string_view text);
std::string encode_utf8(std::u32string_view text);
inline std::string valid_utf8(std::string_view text) {
  return encode_utf8(decode_utf8(text));
}

// While it lives, wcwidth() of this thread knows Unicode, whatever locale the program runs in.
class UnicodeScope {
 public:
  UnicodeScope();
  ~UnicodeScope();
  UnicodeScope(const UnicodeScope&) = delete;
  UnicodeScope& operator=(const UnicodeScope&) = delete;

 private:
  ::locale_t unicode_;
  ::locale_t before_;
};

// The three below need a UnicodeScope.

// Control characters, escape sequences' lead-ins, direction overrides, line separators and unassigned
// characters become U+FFFD.
std::u32string printable(std::string_view text);
std::size_t columns(std::u32string_view printable_text);
// At most `width` >= 1 columns: head, an ellipsis, tail.
std::u32string shortened(std::u32string_view printable_text, std::size_t width);

}  // namespace scene_analyzer::report
