#include "gpu/buffer.h"

#include <numeric>

#include "gpu/error.h"
#include "gpu/faults.h"
#include "gpu/recorder.h"
#include "support/gpu_test.h"

namespace scene_analyzer {
namespace {

using testing::HasSubstr;

std::string out_of_memory_of(gpu::Device& device, const std::string& name, std::uint64_t bytes) {
  try {
    device.make_buffer(name, bytes);
  } catch (const gpu::OutOfMemory& error) {
    return error.what();
  }
  return "no OutOfMemory";
}

// With the parameter, copies go through the staging buffer wherever the memory is.
class BufferTest : public test::GpuTest, public testing::WithParamInterface<bool> {
 protected:
  void SetUp() override { gpu::faults(device()).stage_copies = GetParam(); }
  void TearDown() override {
    gpu::faults(device()).stage_copies = false;
    GpuTest::TearDown();
  }
};
INSTANTIATE_TEST_SUITE_P(Copies, BufferTest, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "Staged" : "Direct"; });

TEST_P(BufferTest, UploadsAndDownloadsParts) {
  const gpu::Array<std::uint32_t> array(device(), "array", 10);
  array.upload(device(), std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  array.upload(device(), std::vector<std::uint32_t>{70, 80}, 7);
  EXPECT_THAT(array.download(device()), testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 70, 80, 9));
  EXPECT_THAT(array.download(device(), 6, 3), testing::ElementsAre(6, 70, 80));
  EXPECT_THAT(array.download(device(), 10, 0), testing::IsEmpty());
}

TEST_P(BufferTest, CopiesMoreThanOneStagingBuffer) {
  const std::uint64_t count = (std::uint64_t{33} << 20) / 4 + 5;  // three times 16 MiB, the last in part
  const gpu::Array<std::uint32_t> array(device(), "array", count);
  std::vector<std::uint32_t> values(count);
  std::iota(values.begin(), values.end(), 3u);
  array.upload(device(), values);
  EXPECT_TRUE(array.download(device()) == values);
}

TEST_P(BufferTest, SeesWhatTheDeviceWrote) {
  const gpu::Array<std::uint32_t> array(device(), "array", 5);
  gpu::Recorder recorder(device());
  recorder.fill(array, 17);
  recorder.submit_and_wait();
  EXPECT_THAT(array.download(device()), testing::Each(testing::Eq(17u)));
}

TEST_P(BufferTest, RefusesCopiesOutsideTheBuffer) {
  const gpu::Array<std::uint32_t> array(device(), "array", 4);
  EXPECT_THROW(array.upload(device(), std::vector<std::uint32_t>{1, 2}, 3), std::logic_error);
  EXPECT_THROW(array.download(device(), 4, 1), std::logic_error);
  EXPECT_THROW(device().download(array.buffer(), ~std::uint64_t{0}, std::as_writable_bytes(std::span<int>())),
               std::logic_error);
}

using BufferLimitTest = test::GpuTest;

TEST_F(BufferLimitTest, RoundsUpAndIsNeverEmpty) {
  EXPECT_EQ(device().make_buffer("none", 0).bytes(), 16u);
  EXPECT_EQ(device().make_buffer("one", 1).bytes(), 16u);
  EXPECT_EQ(device().make_buffer("some", 17).bytes(), 32u);
  EXPECT_EQ(gpu::Buffer().bytes(), 0u);
  EXPECT_FALSE(gpu::Buffer());
}

TEST_F(BufferLimitTest, CountsLiveAndPeakBytes) {
  const std::uint64_t before = device().buffer_bytes();
  device().reset_peak();
  {
    const gpu::Buffer first = device().make_buffer("first", 1000);
    gpu::Buffer second = device().make_buffer("second", 4096);
    EXPECT_EQ(device().buffer_bytes(), before + 1008 + 4096);
    second = gpu::Buffer();
    EXPECT_EQ(device().buffer_bytes(), before + 1008);
  }
  EXPECT_EQ(device().buffer_bytes(), before);
  EXPECT_EQ(device().peak_buffer_bytes(), before + 1008 + 4096);
  device().reset_peak();
  EXPECT_EQ(device().peak_buffer_bytes(), before);
}

TEST_F(BufferLimitTest, OutOfMemoryNamesBufferNeedAndLimit) {
  const gpu::DeviceInfo& info = device().info();
  const std::uint64_t limit = std::min(info.max_storage_buffer_bytes, info.max_allocation_bytes);
  const std::string message = out_of_memory_of(device(), "half-edges", limit + 1);
  EXPECT_THAT(message, HasSubstr("buffer 'half-edges' needs " + std::to_string(limit + 1) + " bytes"));
  EXPECT_THAT(message, HasSubstr(std::to_string(limit)));
  EXPECT_THAT(message,
              testing::AnyOf(HasSubstr("maxStorageBufferRange"), HasSubstr("maxMemoryAllocationSize")));
  EXPECT_THAT(out_of_memory_of(device(), "huge", ~std::uint64_t{0}), HasSubstr("buffer 'huge' needs"));
}

TEST_F(BufferLimitTest, RefusalByTheDriverIsOutOfMemoryAndLeavesNothing) {
  const std::uint64_t before = device().buffer_bytes();
  gpu::faults(device()).allocations_until_failure = 1;
  const gpu::Buffer granted = device().make_buffer("granted", 64);
  EXPECT_THAT(out_of_memory_of(device(), "refused", 128),
              HasSubstr("buffer 'refused' needs 128 bytes, but the driver refused it with " +
                        std::to_string(before + 64) + " bytes in use"));
  EXPECT_EQ(device().buffer_bytes(), before + 64);
  EXPECT_EQ(device().make_buffer("again", 128).bytes(), 128u);  // one failure, not a state
}

}  // namespace
}  // namespace scene_analyzer
