// cases.h — What is measured: the one table of meshes and sizes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/meshes.h"

namespace scene_analyzer::bench {

struct Case {
  std::string name;  // "heightfield/1M": kind and size, part of the benchmark's name
  int rounds;        // each is one run on the device and one of the twin, alternating
  bool by_kernel;    // whether kernels are listed one by one
  std::function<std::vector<test_meshes::TestMesh>()> make;
};

const std::vector<Case>& cases();

}  // namespace scene_analyzer::bench
