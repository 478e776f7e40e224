// strip.h — What tests of the pipeline measure, and what they measure it on.
#pragma once

#include <stdexcept>
#include <string>

#include "gpu/device.h"

namespace scene_analyzer::pipeline {

inline gpu::Device& shared_device() {
  static gpu::Device device;
  return device;
}
inline gpu::Device& no_device() {
  throw std::logic_error("the device was asked for");
}

// A strip of `count` quads of many sizes, the last of them folded and with a fin on its edge, and where asked
// for a triangle without an area.
inline std::string strip(int count, bool degenerate, double size = 1) {
  std::string text;
  for (int i = 0; i <= count; ++i)
    for (const int y : {0, 1})
      text += "v " + std::to_string(size * i * (1 + i % 3)) + ' ' +
              std::to_string(size * y * (1 + 0.01 * i)) + ' ' + std::to_string(i == count ? 1.5 * size : 0) +
              '\n';
  text += "v " + std::to_string(size * count) + " 0.5 2.5\n";
  text += "o strip\n";
  for (int i = 0; i < count; ++i) {
    const auto corner = [&](int column, int y) { return ' ' + std::to_string(2 * (i + column) + y + 1); };
    text += 'f' + corner(0, 0) + corner(1, 0) + corner(1, 1) + '\n';
    text += 'f' + corner(0, 0) + corner(1, 1) + corner(0, 1) + '\n';
  }
  const std::string edge = ' ' + std::to_string(2 * count - 1) + ' ' + std::to_string(2 * count);
  text += 'f' + edge + ' ' + std::to_string(2 * count + 3) + '\n';
  if (degenerate) text += "f 1 1 2\n";
  return text + "o single\nf 1 2 3\n";
}

}  // namespace scene_analyzer::pipeline
