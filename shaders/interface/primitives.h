// primitives.h — Parameters of scan and radix sort.
#ifndef SCENE_ANALYZER_INTERFACE_PRIMITIVES_H
#define SCENE_ANALYZER_INTERFACE_PRIMITIVES_H
#include "types.h"

INTERFACE_BEGIN(primitives)

INTERFACE_CONST uint kScanBlock = 128;  // elements that one thread scans in order

INTERFACE_CONST uint kDigitBits = 8;
INTERFACE_CONST uint kDigits = 256;
INTERFACE_CONST uint kSortThreads = 32;  // per workgroup, one counter column each in shared memory
INTERFACE_CONST uint kKeysPerThread = 128;
INTERFACE_CONST uint kTileKeys = 4096;  // kSortThreads * kKeysPerThread

struct ScanParams {
  uint count;
};

struct SortParams {
  uint count;
  uint shift;  // lowest bit of the digit within the 64-bit key
  uint tiles;
};

INTERFACE_END
#endif
