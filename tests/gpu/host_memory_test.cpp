#include "gpu/host_memory.h"

#include <gtest/gtest.h>

namespace scene_analyzer::gpu {
namespace {

TEST(HostMemoryTest, ReadsMemAvailable) {
  EXPECT_EQ(available_bytes_of_meminfo(
                "MemTotal:       8000 kB\nMemFree:         100 kB\nMemAvailable:   1234 kB\n"),
            1234u * 1024);
}

TEST(HostMemoryTest, UnknownIsAbsentNotZero) {
  EXPECT_FALSE(available_bytes_of_meminfo(""));
  EXPECT_FALSE(available_bytes_of_meminfo("MemTotal: 8000 kB\n"));
  EXPECT_FALSE(available_bytes_of_meminfo("MemAvailable: many\n"));
}

TEST(HostMemoryTest, ThisMachineHasSome) {
  const auto free = free_host_memory_bytes();
  ASSERT_TRUE(free);
  EXPECT_GT(*free, std::uint64_t{1} << 20);
}

}  // namespace
}  // namespace scene_analyzer::gpu
