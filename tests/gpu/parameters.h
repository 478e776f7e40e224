// parameters.h — The parameter blocks of the kernels in this folder.
#ifndef SCENE_ANALYZER_TESTS_GPU_PARAMETERS_H
#define SCENE_ANALYZER_TESTS_GPU_PARAMETERS_H

#include "interface/types.h"

INTERFACE_BEGIN(gpu_test)

struct WriteIndexParams {
  uint count;
  uint offset;
};

// Every kind of member that interfaces use, in an order that other layout rules would pad.
struct WideParams {
  INTERFACE_ARRAY(float, direction, 3);
  uint count;
  INTERFACE_ARRAY(double, origin, 3);
  uint64_t seed;
  float scale;
};

INTERFACE_END
#endif
