// What goes wrong on the way: limits, memory, a lost device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "gpu/error.h"
#include "gpu/faults.h"
#include "spectrum/signals.h"

namespace scene_analyzer::spectrum {
namespace {

using SpectrumFailureTest = test::GpuTest;

template <typename Error>
std::string message_of(SpectrumBuilder& builder, const std::vector<Samples>& signals) {
  try {
    builder.transform(spans_of(signals));
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(SpectrumFailureTest, LimitsThatCannotBe) {
  for (const SpectrumLimits limits :
       {SpectrumLimits{.short_samples = 0}, SpectrumLimits{.short_samples = 5000},
        SpectrumLimits{.window = 2048}, SpectrumLimits{.window = 5000}, SpectrumLimits{.batch = 0}})
    EXPECT_THROW(SpectrumBuilder(device(), limits), std::logic_error);
}

TEST_F(SpectrumFailureTest, SignalsBeyondTheLongest) {
  SpectrumBuilder builder(device());
  const std::uint64_t size = kLongestSignal + 1;
  const auto samples = std::make_unique_for_overwrite<double[]>(size);  // never read
  const std::span<const double> signal(samples.get(), size);
  EXPECT_THROW(builder.transform({&signal, 1}), gpu::OutOfMemory);

  SpectrumBuilder windows(device(), {.window = 1U << 12});
  EXPECT_THAT(
      message_of<gpu::OutOfMemory>(windows, {random_samples(16386, 1)}),
      testing::AllOf(testing::HasSubstr("24576 complex numbers"), testing::HasSubstr("4 buffers of 4096")));
}

// One allocation after the other fails, those of VkFFT's plans too; whatever was made before goes again.
TEST_F(SpectrumFailureTest, OutOfMemoryAtEachAllocation) {
  const std::vector<Samples> signals{random_samples(100, 1), random_samples(1000, 2),
                                     random_samples(9001, 3)};
  SpectrumBuilder sound(device(), {.window = 1U << 12});
  const std::vector<SpectrumTotals> expected = sound.transform(spans_of(signals));
  const std::uint64_t before = device().buffer_bytes();
  std::uint32_t allocations = 0;
  for (bool failed = true; failed; ++allocations) {
    SpectrumBuilder builder(device(), {.window = 1U << 12});
    gpu::faults(device()).allocations_until_failure = allocations;
    try {
      EXPECT_EQ(builder.transform(spans_of(signals)), expected);
      failed = false;
    } catch (const gpu::OutOfMemory& error) {
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr(" need"), testing::HasSubstr(" bytes")));
    }
    gpu::faults(device()).allocations_until_failure.reset();
    EXPECT_EQ(builder.transform(spans_of(signals)), expected);  // it goes on with what it has
  }
  EXPECT_GT(allocations, 30U);
  EXPECT_EQ(device().buffer_bytes(), before);
}

TEST_F(SpectrumFailureTest, LostDevice) {
  for (const std::size_t length : {100U, 1000U, 1000000U}) {
    gpu::Device device(test::device_options());
    SpectrumBuilder builder(device);
    gpu::faults(device).lose_device_at_next_submit = true;
    EXPECT_THAT(message_of<gpu::DeviceLost>(builder, {random_samples(length, 1)}),
                testing::HasSubstr("the GPU was lost"));
    EXPECT_THAT(message_of<gpu::DeviceLost>(builder, {random_samples(length, 1)}),
                testing::HasSubstr("the GPU was lost"));
    EXPECT_THAT(device.take_validation_messages(), testing::IsEmpty());
  }
}

}  // namespace
}  // namespace scene_analyzer::spectrum
