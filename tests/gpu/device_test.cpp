#include "gpu/device.h"

#include <chrono>
#include <cstdio>

#include "gpu/error.h"
#include "support/gpu_test.h"

namespace scene_analyzer {
namespace {

class DeviceTest : public test::GpuTest {};

TEST_F(DeviceTest, DescribesItself) {
  const gpu::DeviceInfo& info = device().info();
  EXPECT_FALSE(info.name.empty());
  EXPECT_FALSE(info.driver.empty());
  EXPECT_THAT(info.api_version, testing::StartsWith("1."));
  EXPECT_TRUE(info.refusals.empty());
  EXPECT_GE(info.max_storage_buffer_bytes, std::uint64_t{1} << 27);
  EXPECT_GE(info.max_allocation_bytes, std::uint64_t{1} << 30);
  EXPECT_GT(info.memory_bytes, 0u);
  EXPECT_GT(info.free_memory_bytes, 0u);
  EXPECT_LE(info.free_memory_bytes, info.memory_bytes);
  EXPECT_GE(info.subgroup_size, 1u);
}

TEST_F(DeviceTest, IsOneOfTheListedDevices) {
  const auto devices = gpu::list_devices();
  const gpu::DeviceInfo& info = device().info();
  ASSERT_LT(info.index, devices.size());
  EXPECT_EQ(devices[info.index].name, info.name);
  for (std::uint32_t i = 0; i < devices.size(); ++i) EXPECT_EQ(devices[i].index, i);
}

TEST_F(DeviceTest, CanBeChosenByIndexAndName) {
  gpu::DeviceOptions options = test::device_options();
  options.selector = std::to_string(device().info().index);
  EXPECT_EQ(gpu::Device(options).info().name, device().info().name);
  options.selector = device().info().name;
  EXPECT_EQ(gpu::Device(options).info().name, device().info().name);
  options.selector = "no such device";
  EXPECT_THROW(gpu::Device{options}, gpu::NoDevice);
}

TEST_F(DeviceTest, StartsWithinASecondOnceTheDriverIsLoaded) {
  gpu::DeviceOptions options = test::device_options();
  options.validation = false;
  const auto start = std::chrono::steady_clock::now();
  const gpu::Device another(options);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  std::printf("instance and device: %.1f ms on %s\n", elapsed.count(), another.info().name.c_str());
  // The usual time is 10 to 20 ms; many tests may be running beside this one.
  EXPECT_LT(elapsed.count(), 1000);
}

}  // namespace
}  // namespace scene_analyzer
