#include "report/svg.h"

#include <fmt/format.h>

#include "report/terminal_text.h"

namespace scene_analyzer::report {
namespace {

constexpr std::size_t kTitleColumns = 60;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else
      result.push_back(c);
  }
  return result;
}

std::string title_of(const std::string& text) {
  const UnicodeScope unicode;
  return escaped(encode_utf8(shortened(printable(text), kTitleColumns)));
}

}  // namespace

std::string svg_head(std::uint32_t width, std::uint32_t height, std::uint32_t left,
                     const std::string& title) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"#fff\"/>\n",
      width, height);
  const std::string name = title_of(title);
  out += fmt::format("<title>{}</title>\n", name);
  append_text(out, left, 22, "start", name, " font-size=\"16\" font-weight=\"bold\"");
  return out;
}

void append_text(std::string& out, double x, double y, const char* anchor, const std::string& text,
                 const char* more) {
  out += fmt::format("<text x=\"{:.6g}\" y=\"{:.6g}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     text);
}

void append_upright(std::string& out, double x, double y, const char* anchor, const std::string& text) {
  append_text(out, x, y, anchor, text, fmt::format(" transform=\"rotate(-90 {:.6g} {:.6g})\"", x, y).c_str());
}

}  // namespace scene_analyzer::report
