#include "gpu/device_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu/error.h"

namespace scene_analyzer::gpu {
namespace {

using testing::AllOf;
using testing::HasSubstr;

DeviceInfo make_device(std::uint32_t index, const std::string& name, DeviceType type,
                       std::vector<std::string> refusals = {}) {
  DeviceInfo info;
  info.index = index;
  info.name = name;
  info.driver = "made-up 1.0";
  info.api_version = "1.3.0";
  info.type = type;
  info.refusals = std::move(refusals);
  return info;
}

std::string refusal_of(const std::vector<DeviceInfo>& devices, const std::string& selector) {
  try {
    select_device(devices, selector);
  } catch (const NoDevice& error) {
    return error.what();
  }
  return "no NoDevice";
}

const std::vector<DeviceInfo> kDevices{
    make_device(0, "llvmpipe (LLVM 15.0.6, 256 bits)", DeviceType::kCpu),
    make_device(1, "Virtio-GPU Venus", DeviceType::kVirtual),
    make_device(2, "Intel(R) UHD Graphics 630", DeviceType::kIntegrated),
    make_device(3, "NVIDIA GeForce RTX 4090", DeviceType::kDiscrete, {"no double precision in shaders"}),
    make_device(4, "NVIDIA GeForce GTX 1080", DeviceType::kDiscrete),
    make_device(5, "NVIDIA GeForce GTX 1070", DeviceType::kDiscrete),
};

TEST(DeviceSelectionTest, PrefersTheStrongerType) {
  std::vector<DeviceInfo> devices = kDevices;
  const std::vector<std::size_t> order{4, 5, 2, 1, 0};
  for (const std::size_t expected : order) {
    EXPECT_EQ(select_device(devices, ""), expected);
    devices[expected].refusals = {"asked away"};
  }
  EXPECT_THROW(select_device(devices, ""), NoDevice);
}

TEST(DeviceSelectionTest, TakesAnIndexOrAPartOfTheName) {
  EXPECT_EQ(select_device(kDevices, "0"), 0u);
  EXPECT_EQ(select_device(kDevices, "2"), 2u);
  EXPECT_EQ(select_device(kDevices, "uhd"), 2u);
  EXPECT_EQ(select_device(kDevices, "LLVMPIPE"), 0u);
  EXPECT_EQ(select_device(kDevices, "GTX 1070"), 5u);
  EXPECT_EQ(select_device(kDevices, "geforce"), 4u);  // the first usable one of three
}

TEST(DeviceSelectionTest, RefusedDeviceIsNotReplacedByAnother) {
  EXPECT_THAT(refusal_of(kDevices, "3"), AllOf(HasSubstr("device '3' cannot be used"), HasSubstr("RTX 4090"),
                                               HasSubstr("no double precision")));
  EXPECT_THAT(refusal_of(kDevices, "rtx"), HasSubstr("device 'rtx' cannot be used"));
}

TEST(DeviceSelectionTest, UnknownSelectorListsTheDevices) {
  EXPECT_THAT(refusal_of(kDevices, "radeon"),
              AllOf(HasSubstr("'radeon'"),
                    HasSubstr("0: llvmpipe (LLVM 15.0.6, 256 bits) (cpu, made-up 1.0, "
                              "Vulkan 1.3.0): usable"),
                    HasSubstr("5: NVIDIA GeForce GTX 1070 (discrete")));
  EXPECT_THAT(refusal_of(kDevices, "6"),
              HasSubstr("no device is number or has the name '6'"));  // not "256 bits"
  EXPECT_THAT(refusal_of(kDevices, "-1"), HasSubstr("'-1'"));
}

TEST(DeviceSelectionTest, NothingUsableGivesEveryReasonAndTheRemedy) {
  const std::vector<DeviceInfo> devices{
      make_device(0, "Old", DeviceType::kDiscrete, {"Vulkan 1.3 is needed, the driver offers 1.1.0"}),
      make_device(1, "Small", DeviceType::kIntegrated, {"no double precision", "no push descriptors"})};
  EXPECT_THAT(refusal_of(devices, ""),
              AllOf(HasSubstr("0: Old (discrete, made-up 1.0, Vulkan 1.3.0): Vulkan 1.3 is needed"),
                    HasSubstr("no double precision; no push descriptors"), HasSubstr("mesa-vulkan-drivers")));
  EXPECT_THAT(refusal_of({}, ""), HasSubstr("mesa-vulkan-drivers"));
}

}  // namespace
}  // namespace scene_analyzer::gpu
