#include "gpu/recorder.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "gpu/error.h"
#include "gpu/faults.h"
#include "logic_error.h"
#include "parameters.h"
#include "support/gpu_test.h"
// Generated:
#include "add_scaled.spv.h"
#include "write_index.spv.h"

namespace scene_analyzer {
namespace {

using interface::gpu_test::WriteIndexParams;
using testing::Each;
using testing::ElementsAre;
using testing::Eq;
using testing::HasSubstr;

constexpr std::uint32_t kUntouched = 0xabcdabcdu;

class RecorderTest : public test::GpuTest {
 protected:
  gpu::Kernel write_index() { return device().make_kernel("write_index", write_index_spv); }
  gpu::Kernel add_scaled() { return device().make_kernel("add_scaled", add_scaled_spv); }
  gpu::Array<std::uint32_t> words(const std::string& name, std::uint64_t count) {
    return {device(), name, count};
  }
};

class RecorderSizeTest : public RecorderTest, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(RecorderSizeTest, EveryElementIsWrittenOnceAndNothingElse) {
  const std::uint32_t count = GetParam();
  const gpu::Kernel kernel = write_index();
  const auto values = words("values", count + 1);
  const auto counted = words("counted", 1);
  gpu::Recorder recorder(device());
  recorder.fill(values, kUntouched);
  recorder.fill(counted, 0);
  recorder.run(kernel, count, WriteIndexParams{count, 7}, {values, counted});
  recorder.submit_and_wait();

  const auto result = values.download(device());
  std::vector<std::uint32_t> expected(count + 1);
  std::iota(expected.begin(), expected.end(), 7);
  expected.back() = kUntouched;
  EXPECT_TRUE(result == expected) << "first difference at "
                                  << std::mismatch(result.begin(), result.end(), expected.begin()).first -
                                         result.begin();
  // Whole workgroups, and of a folded dispatch less than one row of surplus groups.
  const std::uint32_t threads = counted.download(device())[0];
  const std::uint32_t groups = (count + 63) / 64;
  EXPECT_GE(threads, count);
  EXPECT_LT(threads, (groups + groups / 65535 + 1) * 64);
}

INSTANTIATE_TEST_SUITE_P(Sizes, RecorderSizeTest,
                         testing::Values(0, 1, 63, 64, 65, 255, 256, 257, 65535 * 64, 65535 * 64 + 1,
                                         2 * 65535 * 64 + 1));

TEST_F(RecorderTest, StepsSeeWhatEarlierStepsWrote) {
  const gpu::Kernel kernel = add_scaled();
  const auto a = words("a", 1000);
  const auto b = words("b", 1000);
  gpu::Recorder recorder(device());
  recorder.fill(a, 1);
  recorder.fill(b, 0);
  for (int i = 0; i < 4; ++i) {
    recorder.run(kernel, 1000, gpu::NoParams{}, {a, b});
    recorder.run(kernel, 1000, gpu::NoParams{}, {b, a});
  }
  recorder.submit_and_wait();
  std::uint32_t expected_a = 1, expected_b = 0;
  for (int i = 0; i < 4; ++i) {
    expected_b += 3 * expected_a;
    expected_a += 3 * expected_b;
  }
  EXPECT_THAT(a.download(device()), Each(Eq(expected_a)));
  EXPECT_THAT(b.download(device()), Each(Eq(expected_b)));
}

TEST_F(RecorderTest, RunGroupsRunsWholeWorkgroups) {
  const gpu::Kernel kernel = write_index();
  const auto values = words("values", 640);
  const auto counted = words("counted", 1);
  gpu::Recorder recorder(device());
  recorder.fill(counted, 0);
  recorder.run_groups(kernel, 10, WriteIndexParams{640, 0}, {values, counted});
  recorder.submit_and_wait();
  EXPECT_EQ(counted.download(device())[0], 640u);
}

TEST_F(RecorderTest, FillsAndCopiesParts) {
  const auto from = words("from", 8);
  const auto to = words("to", 8);
  from.upload(device(), std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7});
  gpu::Recorder recorder(device());
  recorder.fill(to, 9);
  recorder.fill({to.buffer(), 4, 8}, 5);
  recorder.copy(from.buffer(), 8, to.buffer(), 16, 12);
  recorder.copy(to.buffer(), 0, to.buffer(), 28, 4);
  recorder.copy(from.buffer(), 0, to.buffer(), 0, 0);
  recorder.submit_and_wait();
  EXPECT_THAT(to.download(device()), ElementsAre(9, 5, 5, 9, 2, 3, 4, 9));
}

TEST_F(RecorderTest, BindsPartsOfBuffers) {
  const gpu::Kernel kernel = add_scaled();
  const auto source = words("source", 128);
  const auto target = words("target", 128);
  source.upload(device(), std::vector<std::uint32_t>(128, 2));
  gpu::Recorder recorder(device());
  recorder.fill(target, 1);
  // 100 threads, but the parts have 64 and 4 elements: length() tells the shader.
  recorder.run(kernel, 100, gpu::NoParams{}, {{source.buffer(), 256, 0}, {target.buffer(), 256, 16}});
  recorder.submit_and_wait();
  const auto result = target.download(device());
  EXPECT_EQ(result[63], 1u);
  EXPECT_EQ(result[64], 7u);
  EXPECT_EQ(result[67], 7u);
  EXPECT_EQ(result[68], 1u);
}

TEST_F(RecorderTest, IsEmptyAndUsableAfterSubmission) {
  const auto values = words("values", 4);
  gpu::Recorder recorder(device());
  recorder.submit_and_wait();  // nothing recorded
  recorder.fill(values, 1);
  recorder.submit_and_wait();
  values.upload(device(), std::vector<std::uint32_t>{2, 2, 2, 2});
  recorder.submit_and_wait();  // must not run the fill again
  EXPECT_THAT(values.download(device()), Each(Eq(2u)));
  recorder.fill(values, 3);
  recorder.submit_and_wait();
  EXPECT_THAT(values.download(device()), Each(Eq(3u)));
}

TEST_F(RecorderTest, KeepsScratchUntilItHasRun) {
  const std::uint64_t before = device().buffer_bytes();
  gpu::Recorder recorder(device());
  const auto& scratch = recorder.keep(words("scratch", 1024));
  recorder.fill(scratch, 1);
  EXPECT_EQ(device().buffer_bytes(), before + 4096);
  recorder.submit_and_wait();
  EXPECT_EQ(device().buffer_bytes(), before);
}

TEST_F(RecorderTest, CanBeDroppedUnsubmitted) {
  const auto values = words("values", 4);
  values.upload(device(), std::vector<std::uint32_t>{1, 1, 1, 1});
  {
    gpu::Recorder recorder(device());
    recorder.fill(values, 2);
  }
  EXPECT_THAT(values.download(device()), Each(Eq(1u)));
}

TEST_F(RecorderTest, RefusesWrongArguments) {
  const gpu::Kernel kernel = write_index();
  const auto values = words("values", 64);
  const auto counted = words("counted", 1);
  gpu::Recorder recorder(device());
  const WriteIndexParams params{64, 0};
  EXPECT_THAT(logic_error_of([&] { recorder.run(kernel, 64, params, {values}); }),
              HasSubstr("kernel 'write_index': got 1 buffers, the shader has 2"));
  EXPECT_THAT(logic_error_of([&] {
                recorder.run(kernel, 64, params, {values, counted, counted});
              }),
              HasSubstr("got 3 buffers"));
  EXPECT_THAT(logic_error_of([&] {
                recorder.run(kernel, 64, std::uint32_t{1}, {values, counted});
              }),
              HasSubstr("got 4 bytes of parameters, the shader has 8"));
  EXPECT_THAT(logic_error_of([&] {
                recorder.run(kernel, 64, gpu::NoParams{}, {values, counted});
              }),
              HasSubstr("got 0 bytes of parameters"));
  EXPECT_THAT(logic_error_of([&] {
                recorder.run(kernel, 64, params, {values, gpu::Buffer()});
              }),
              HasSubstr("a buffer is empty"));
  EXPECT_THAT(logic_error_of([&] {
                recorder.run(kernel, std::uint64_t{1} << 33, params, {values, counted});
              }),
              HasSubstr("exceed 32-bit indices"));
}

TEST_F(RecorderTest, RefusesRangesOutsideTheirBuffer) {
  const gpu::Kernel kernel = add_scaled();
  const auto values = words("values", 128);
  const auto other = words("other", 128);
  gpu::Recorder recorder(device());
  const auto bind = [&](std::uint64_t offset, std::uint64_t size) {
    return logic_error_of([&] {
      recorder.run(kernel, 1, gpu::NoParams{}, {{values.buffer(), offset, size}, other});
    });
  };
  EXPECT_THAT(bind(512, 0), HasSubstr("offset 512 is outside buffer 'values' of 512 bytes"));
  EXPECT_THAT(bind(256, 260), HasSubstr("260 bytes from offset 256 exceed buffer 'values'"));
  EXPECT_THAT(bind(2, 4), HasSubstr("not a multiple of"));
  EXPECT_THAT(logic_error_of([&] {
                recorder.fill({values.buffer(), 2, 4}, 0);
              }),
              HasSubstr("not multiples of 4"));
  EXPECT_THAT(logic_error_of([&] { recorder.copy(values.buffer(), 0, other.buffer(), 500, 16); }),
              HasSubstr("16 bytes from offset 500 exceed buffer 'other'"));
  EXPECT_THAT(logic_error_of([&] { recorder.copy(values.buffer(), 0, values.buffer(), 8, 16); }),
              HasSubstr("overlap"));
}

TEST_F(RecorderTest, ProfileTimesEveryDispatchInOrder) {
  const gpu::Kernel first = write_index();
  const gpu::Kernel second = add_scaled();
  const auto a = words("a", 1 << 20);
  const auto b = words("b", 1 << 20);
  gpu::Recorder recorder(device(), true);
  for (int round = 0; round < 2; ++round) {  // the second reuses what the first made
    recorder.fill(b, 0);
    recorder.run(first, 1 << 20, WriteIndexParams{1 << 20, 0}, {a, b});
    for (int i = 0; i < 300; ++i) recorder.run(second, 64, gpu::NoParams{}, {a, b});
    recorder.submit_and_wait();
    ASSERT_EQ(recorder.timings().size(), 301u);
    EXPECT_EQ(recorder.timings().front().kernel, "write_index");
    EXPECT_EQ(recorder.timings().back().kernel, "add_scaled");
    double total = 0;
    for (const auto& timing : recorder.timings()) {
      ASSERT_TRUE(timing.nanoseconds);
      total += *timing.nanoseconds;
    }
    EXPECT_GT(recorder.timings().front().nanoseconds.value(), 0);
    EXPECT_LT(total, 60e9);
  }
  recorder.submit_and_wait();
  EXPECT_TRUE(recorder.timings().empty());
}

TEST_F(RecorderTest, WithoutProfileThereAreNoTimings) {
  const auto a = words("a", 64);
  gpu::Recorder recorder(device());
  recorder.run(add_scaled(), 0, gpu::NoParams{}, {a, a});
  recorder.fill(a, 0);
  recorder.submit_and_wait();
  EXPECT_TRUE(recorder.timings().empty());
}

TEST_F(RecorderTest, FailedStepLeavesTheRecordingUsable) {
  const gpu::Kernel kernel = add_scaled();
  const auto values = words("values", 64);
  gpu::Recorder recorder(device());
  recorder.fill(values, 4);
  EXPECT_THROW(recorder.run(kernel, 64, gpu::NoParams{}, {values}), std::logic_error);
  recorder.submit_and_wait();
  EXPECT_THAT(values.download(device()), Each(Eq(4u)));
}

TEST_F(RecorderTest, LostDeviceIsReportedAndStaysLost) {
  gpu::Device doomed(test::device_options());
  const gpu::Array<std::uint32_t> values(doomed, "values", 64);
  gpu::faults(doomed).lose_device_at_next_submit = true;
  gpu::Recorder recorder(doomed);
  const std::uint64_t before = doomed.buffer_bytes();
  recorder.fill(recorder.keep(gpu::Array<std::uint32_t>(doomed, "scratch", 64)), 1);
  try {
    recorder.submit_and_wait();
    FAIL() << "no DeviceLost";
  } catch (const gpu::DeviceLost& error) {
    EXPECT_THAT(error.what(), HasSubstr("the GPU was lost while running 1 recorded steps"));
    EXPECT_THAT(error.what(), HasSubstr("Start again"));
  }
  EXPECT_EQ(doomed.buffer_bytes(), before);  // kept scratch is freed on this way too
  EXPECT_THROW(recorder.fill(values, 1), gpu::DeviceLost);
  recorder.submit_and_wait();  // nothing recorded
  EXPECT_THAT(doomed.take_validation_messages(), testing::IsEmpty());
}

}  // namespace
}  // namespace scene_analyzer
