// VkFFT behind its face: each length, fewer rows than planned, and roots of unity for the tables around it.
#include "spectrum/fft_plan.h"

#include <fftw3.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "gpu/recorder.h"
#include "spectrum/roots.h"
#include "support/gpu_test.h"
#include "support/meshes.h"

namespace scene_analyzer::spectrum {
namespace {

using FftPlanTest = test::GpuTest;

std::vector<Complex> random_rows(std::size_t count) {
  test_meshes::Random random(count);
  std::vector<Complex> values(count);
  for (Complex& value : values) value = {random.between(-1, 1), random.between(-1, 1)};
  return values;
}

void transform_with_fftw(Complex* row, std::uint32_t length) {
  auto* data = reinterpret_cast<fftw_complex*>(row);
  fftw_plan plan = fftw_plan_dft_1d(static_cast<int>(length), data, data, FFTW_FORWARD, FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
}

TEST_F(FftPlanTest, TransformsTheRowsAskedForAndLeavesOtherGroupsAlone) {
  constexpr std::uint32_t kCapacity = 300;
  EXPECT_GE(longest_fft_row(device()), 1024U);
  for (std::uint32_t length = 2; length <= longest_fft_row(device()); length *= 2) {
    FftPlan plan(device(), length, kCapacity);
    const std::uint32_t group = plan.rows_per_group();
    for (const std::uint32_t rows : {1U, 2U, group, group + 1, kCapacity}) {
      if (rows > kCapacity) continue;
      const std::uint32_t whole_groups = (rows + group - 1) / group * group;
      const std::vector<Complex> before = random_rows(std::size_t{length} * (whole_groups + 1));
      const gpu::Array<Complex> array(device(), "rows", before.size());
      array.upload(device(), before);
      plan.bind(array.buffer());
      gpu::Recorder recorder(device());
      plan.record(recorder, rows);
      recorder.submit_and_wait();
      const std::vector<Complex> after = array.download(device());
      std::vector<Complex> expected = before;
      for (std::uint32_t row = 0; row < rows; ++row) transform_with_fftw(&expected[row * length], length);
      double worst = 0;
      for (std::size_t i = 0; i < std::size_t{rows} * length; ++i)
        worst = std::max(worst, std::abs(after[i] - expected[i]));
      EXPECT_LE(worst, 1e-12 * std::sqrt(length)) << rows << " rows of " << length;
      for (std::size_t i = std::size_t{whole_groups} * length; i < before.size(); ++i)
        ASSERT_EQ(after[i], before[i]) << rows << " rows of " << length;
    }
  }
}

TEST_F(FftPlanTest, RunsTwiceInOneRecording) {
  FftPlan plan(device(), 256, 4);
  const std::vector<Complex> before = random_rows(4 * 256);
  const gpu::Array<Complex> array(device(), "rows", before.size());
  array.upload(device(), before);
  plan.bind(array.buffer());
  gpu::Recorder recorder(device(), true);
  plan.record(recorder, 4);
  plan.record(recorder, 4);
  recorder.submit_and_wait();
  // Twice forward: 256 times the samples in reverse order.
  const std::vector<Complex> after = array.download(device());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LE(std::abs(after[i] / 256.0 - before[i / 256 * 256 + (256 - i % 256) % 256]), 1e-14);
  for (const gpu::Recorder::Timing& timing : recorder.timings())
    EXPECT_EQ(timing.kernel, "Fourier transform of 256");
}

TEST_F(FftPlanTest, RefusesRowsBeyondItsCapacity) {
  FftPlan plan(device(), 16, 2);
  gpu::Recorder recorder(device());
  EXPECT_THROW(plan.record(recorder, 0), std::logic_error);
  EXPECT_THROW(plan.record(recorder, 3), std::logic_error);
}

TEST(Roots, AreExactToTheLastBits) {
  for (const std::uint64_t n : {1U, 2U, 3U, 8U, 12U, 97U, 1000U, 94074U, 1U << 20}) {
    for (std::uint64_t j = 0; j < 2 * n; j += 1 + n / 50) {
      const long double angle = 2 * std::numbers::pi_v<long double> * static_cast<long double>(j % n) / n;
      const Complex root = root_of_unity(j, n);
      EXPECT_NEAR(root.real(), static_cast<double>(std::cos(angle)), 2e-16) << j << " of " << n;
      EXPECT_NEAR(root.imag(), static_cast<double>(-std::sin(angle)), 2e-16) << j << " of " << n;
    }
  }
  // Symmetric ones are equal but for signs, and those on the axes exact.
  EXPECT_EQ(root_of_unity(2, 8), Complex(0, -1));
  EXPECT_EQ(root_of_unity(500, 1000), Complex(-1, 0));
  EXPECT_EQ(root_of_unity(1, 97).real(), root_of_unity(96, 97).real());
  EXPECT_EQ(root_of_unity(1, 97).imag(), -root_of_unity(96, 97).imag());
}

}  // namespace
}  // namespace scene_analyzer::spectrum
