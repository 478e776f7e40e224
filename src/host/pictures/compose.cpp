#include "pictures/compose.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "report/terminal_text.h"
#include "scene_render/look.h"

namespace scene_analyzer::pictures {
namespace {

using ratings::Rgb;

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDeleter {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;
using Context = std::unique_ptr<cairo_t, ContextDeleter>;

constexpr Rgb kInk = {0.13, 0.13, 0.13}, kSmallInk = {0.35, 0.35, 0.35}, kPaper = {0.96, 0.96, 0.96};
// Sizes below are those of a picture of this width and height, in pixels.
constexpr double kUsualWidth = 1280, kUsualHeight = 720, kUsualLegend = 76, kUsualRing = 14;
constexpr std::size_t kMostColumns = 90;  // of a text

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("drawing the legend: ") + cairo_status_to_string(status));
}

double scale_of(std::uint32_t width, std::uint32_t height) {
  return std::clamp(std::min(width / kUsualWidth, height / kUsualHeight), 0.45, 8.0);
}

// Names come from files: Cairo refuses what is not UTF-8.
std::string fit_to_show(const std::string& text) {
  const report::UnicodeScope unicode;
  return report::encode_utf8(report::shortened(report::printable(text), kMostColumns));
}

// Draws in units of the usual picture.
class Strip {
 public:
  Strip(cairo_surface_t* surface, double top, double scale) : context_(cairo_create(surface)) {
    check(cairo_status(context_.get()));
    cairo_translate(context_.get(), 0, top);
    cairo_scale(context_.get(), scale, scale);
  }

  void rectangle(double x, double y, double width, double height, const Rgb& color) {
    set(color);
    cairo_rectangle(context_.get(), x, y, width, height);
    cairo_fill(context_.get());
  }
  void triangle(double x, double y, double size, const Rgb& color) {
    set(color);
    cairo_move_to(context_.get(), x, y);
    cairo_line_to(context_.get(), x - size / 2, y - size);
    cairo_line_to(context_.get(), x + size / 2, y - size);
    cairo_fill(context_.get());
  }
  // `anchor` 0: x is the left end, 0.5: the middle, 1: the right end. y is the base line.
  void text(const std::string& any_text, double x, double y, double size, const Rgb& color, double anchor = 0,
            bool bold = false) {
    cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_.get(), size);
    const std::string text = fit_to_show(any_text);
    cairo_text_extents_t extents;
    cairo_text_extents(context_.get(), text.c_str(), &extents);
    set(color);
    cairo_move_to(context_.get(), x - anchor * extents.x_advance, y);
    cairo_show_text(context_.get(), text.c_str());
  }
  void clip(double x, double y, double width, double height) {
    cairo_rectangle(context_.get(), x, y, width, height);
    cairo_clip(context_.get());
  }
  void end_clip() { cairo_reset_clip(context_.get()); }
  void stripe(double x, double y, double length, double width, const Rgb& color) {
    set(color);
    cairo_set_line_width(context_.get(), width);
    cairo_move_to(context_.get(), x, y);
    cairo_line_to(context_.get(), x + length, y - length);
    cairo_stroke(context_.get());
  }
  void ring(double x, double y, double radius, double width, const Rgb& color) {
    set(color);
    cairo_set_line_width(context_.get(), width);
    cairo_new_path(context_.get());  // not from where the last text ended
    cairo_arc(context_.get(), x, y, radius, 0, 2 * std::numbers::pi);
    cairo_stroke(context_.get());
  }
  void finish() { check(cairo_status(context_.get())); }

 private:
  void set(const Rgb& color) { cairo_set_source_rgb(context_.get(), color[0], color[1], color[2]); }
  Context context_;
};

void draw_bar(Strip& strip, const Legend& legend, double left, double width) {
  constexpr double kTop = 22, kHeight = 20;
  constexpr int kSteps = 256;
  for (int i = 0; i < kSteps; ++i)  // each reaches to the end, so that no seam shows between them
    strip.rectangle(left + width * i / kSteps, kTop, width - width * i / kSteps, kHeight,
                    legend.bar((i + 0.5) / kSteps));
  for (const auto& [along, text] : legend.ticks) {
    strip.rectangle(left + width * along - 0.5, kTop + kHeight, 1, 4, kInk);
    // The outermost texts stay within the bar when they are long.
    const double anchor = text.size() < 6 ? 0.5 : along;
    strip.text(text, left + width * along, kTop + kHeight + 18, 12, kInk, anchor);
  }
  if (!legend.present) return;
  for (const double along : {legend.present->first, legend.present->second})
    strip.triangle(left + width * along, kTop - 1, 9, kInk);
}

void draw_missing(Strip& strip, double left) {
  constexpr double kTop = 22, kSize = 20;
  const Rgb& grey = scene_render::kNoValueGrey;
  strip.rectangle(left, kTop, kSize, kSize, grey);
  strip.clip(left, kTop, kSize, kSize);
  for (int i = 0; i < 5; ++i)
    strip.stripe(
        left - 20 + 8 * i, kTop + kSize + 4, 30, 2.8,
        {grey[0] * scene_render::kStripe, grey[1] * scene_render::kStripe, grey[2] * scene_render::kStripe});
  strip.end_clip();
  strip.text("no value", left + kSize / 2, kTop + kSize + 18, 12, kInk, 0.5);
}

void draw_legend(cairo_surface_t* surface, const Legend& legend, double top, double scale, double pixels) {
  Strip strip(surface, top, scale);
  const double width = pixels / scale, margin = 24, bar_width = std::min(430.0, 0.36 * width);
  strip.rectangle(0, 0, width, kUsualLegend + 1, kPaper);
  const double missing = legend.without_value ? 86 : 0;
  const double bar_left = width - margin - missing - bar_width;
  strip.clip(0, 0, legend.bar ? bar_left - margin / 2 : width, kUsualLegend + 1);
  strip.text(legend.title, margin, 28, 19, kInk, 0, true);
  for (std::size_t i = 0; i < legend.lines.size(); ++i)
    strip.text(legend.lines[i], margin, 47 + 17 * static_cast<double>(i), 13, kSmallInk);
  strip.end_clip();
  if (legend.bar) draw_bar(strip, legend, bar_left, bar_width);
  if (legend.without_value) draw_missing(strip, width - margin - 45);
  strip.finish();
}

void draw_marks(cairo_surface_t* surface, std::span<const Mark> marks, double scale, double width) {
  Strip view(surface, 0, scale);
  double middle = 0;
  for (const Mark& mark : marks) middle += mark.x / static_cast<double>(marks.size());
  for (const Mark& mark : marks) {
    view.ring(mark.x / scale, mark.y / scale, kUsualRing, 3.5, kPaper);  // readable on any colour
    view.ring(mark.x / scale, mark.y / scale, kUsualRing, 1.5, kInk);
    // Away from the other rings, where there is room.
    const bool left = mark.x > 0.8 * width || (mark.x < middle && mark.x > 0.2 * width);
    view.text(mark.name, mark.x / scale + (left ? -1 : 1) * (kUsualRing + 5), mark.y / scale + 4, 12, kInk,
              left ? 1 : 0);
  }
  view.finish();
}

// Cairo's pixels are native words, alpha highest; those of the view are opaque.
void copy_view(const scene_render::Picture& view, cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  unsigned char* rows = cairo_image_surface_get_data(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  for (std::size_t y = 0; y < view.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(rows + y * stride);
    for (std::size_t x = 0; x < view.width; ++x) {
      const std::uint8_t* pixel = &view.rgba[4 * (y * view.width + x)];
      row[x] = 0xff000000u | std::uint32_t{pixel[0]} << 16 | std::uint32_t{pixel[1]} << 8 | pixel[2];
    }
  }
  cairo_surface_mark_dirty(surface);
}

struct Output {
  std::string bytes;
  const std::function<void()>& look;
  std::exception_ptr thrown;
};

// Nothing may be thrown through Cairo.
cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  Output& output = *static_cast<Output*>(closure);
  try {
    if (output.look) output.look();
    output.bytes.append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  } catch (...) {
    output.thrown = std::current_exception();
    return CAIRO_STATUS_WRITE_ERROR;
  }
}

std::string compress(cairo_surface_t* surface, const std::function<void()>& look) {
  Output output{{}, look, nullptr};
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface, append, &output);
  if (output.thrown) std::rethrow_exception(output.thrown);
  check(status);
  return std::move(output.bytes);
}

}  // namespace

std::uint32_t legend_height(std::uint32_t width, std::uint32_t height) {
  const auto rows = static_cast<std::uint32_t>(std::lround(kUsualLegend * scale_of(width, height)));
  return std::min(rows, height / 2);
}

double mark_radius(std::uint32_t width, std::uint32_t height) {
  return kUsualRing * scale_of(width, height);
}

std::string compose(const scene_render::Picture& view, std::span<const Mark> marks, const Legend& legend,
                    std::uint32_t height, const std::function<void()>& look) {
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(view.width), static_cast<int>(height)));
  check(cairo_surface_status(surface.get()));
  copy_view(view, surface.get());
  draw_marks(surface.get(), marks, scale_of(view.width, height), view.width);
  if (view.height < height)
    draw_legend(surface.get(), legend, view.height, scale_of(view.width, height), view.width);
  return compress(surface.get(), look);
}

}  // namespace scene_analyzer::pictures
