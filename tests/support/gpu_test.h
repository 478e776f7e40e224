// gpu_test.h — Base of every test that runs on a device: one Device per process, and no silent validation
// message.
//
// The validation layer is on unless SCENE_ANALYZER_VALIDATION=0; in builds with AddressSanitizer it is off
// unless SCENE_ANALYZER_VALIDATION=1, because the layer itself leaks. SCENE_ANALYZER_TEST_DEVICE selects the
// device as --device does.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "gpu/device.h"

namespace scene_analyzer::test {

inline std::string environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr ? otherwise : value;
}

#ifdef __SANITIZE_ADDRESS__
inline constexpr const char* kValidationByDefault = "0";
#else
inline constexpr const char* kValidationByDefault = "1";
#endif

inline gpu::DeviceOptions device_options() {
  gpu::DeviceOptions options;
  options.selector = environment("SCENE_ANALYZER_TEST_DEVICE", "");
  options.validation = environment("SCENE_ANALYZER_VALIDATION", kValidationByDefault) != "0";
  return options;
}

class GpuTest : public testing::Test {
 protected:
  // The driver stays loaded from here on: unloaded, its own leaks could not be told from ours by name.
  GpuTest() { device(); }

  // Made once and kept for the process: a device costs more than most tests.
  static gpu::Device& device() {
    if (!shared()) shared() = std::make_unique<gpu::Device>(device_options());
    return *shared();
  }

  void TearDown() override { EXPECT_THAT(device().take_validation_messages(), testing::IsEmpty()); }

 private:
  // Never destroyed: when static objects die, the driver's own may already be gone.
  static std::unique_ptr<gpu::Device>& shared() {
    static auto& kept = *new std::unique_ptr<gpu::Device>;
    return kept;
  }
};

}  // namespace scene_analyzer::test
