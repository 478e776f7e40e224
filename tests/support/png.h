// png.h — Reads PNG files, with another decoder's help.
#pragma once

#include <cairo.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace scene_analyzer::test {

struct Png {
  int width = 0, height = 0;
  std::vector<std::array<int, 3>> pixels;  // red, green, blue, rows from the top

  const std::array<int, 3>& at(int x, int y) const {
    return pixels.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x));
  }
};

inline Png decode_png(const std::string& bytes) {
  struct Source {
    const std::string& bytes;
    std::size_t done = 0;
  } source{bytes};
  const auto read = [](void* closure, unsigned char* data, unsigned int length) {
    auto& from = *static_cast<Source*>(closure);
    if (from.bytes.size() - from.done < length) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(data, from.bytes.data() + from.done, length);
    from.done += length;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(read, &source);
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) {
    cairo_surface_destroy(surface);
    throw std::runtime_error("not a PNG file");
  }
  Png png{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* rows = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < png.height; ++y)
    for (int x = 0; x < png.width; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, rows + y * stride + 4 * x, sizeof pixel);
      png.pixels.push_back({static_cast<int>(pixel >> 16 & 255), static_cast<int>(pixel >> 8 & 255),
                            static_cast<int>(pixel & 255)});
    }
  cairo_surface_destroy(surface);
  return png;
}

}  // namespace scene_analyzer::test
