// tables.h — Everything measured, printed as the Markdown of docs/performance.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device_run.h"
#include "gpu/device.h"
#include "subject.h"

namespace scene_analyzer::bench {

// Rounds of one stage (or of the whole) of one case.
struct Row {
  std::string which;  // the case
  std::string stage;
  std::uint64_t triangles = 0;
  std::uint64_t peak_bytes = 0;  // of the whole
  std::vector<Round> rounds;
  // Of each side the fastest round: whatever else a machine does only ever adds.
  Round least() const;
  double ratio() const { return least().device.wall / least().twin.wall; }
  // Of the rounds' ratios: in one round the machine is about equally busy for both sides.
  double median_ratio() const;
};

struct KernelTable {
  std::string which;
  std::uint64_t triangles = 0;
  std::vector<Profile> stages;
};

void print_machine(const gpu::DeviceInfo& device);
void print_rows(const std::vector<Row>& rows);
void print_kernels(const KernelTable& table);
// Cost per triangle along the sizes of each kind of mesh, and many meshes against one; lines whose cases did
// not all run are left out.
void print_targets(const std::vector<Row>& rows);

}  // namespace scene_analyzer::bench
