// Draws: what ends up in which pixel, what is counted and timed, what is refused.
#include <array>
#include <cstdint>
#include <limits>

#include "gpu/error.h"
#include "gpu/faults.h"
#include "gpu/recorder.h"
#include "gpu/stopwatch.h"
#include "logic_error.h"
#include "support/gpu_test.h"
// Generated:
#include "flat_frag.spv.h"
#include "flat_vert.spv.h"

namespace scene_analyzer {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kSize = 16;  // pixels each way
using Color = std::array<float, 4>;
constexpr Color kRed = {1, 0, 0, 1}, kGreen = {0, 1, 0, 1}, kBlue = {0, 0, 1, 1};
constexpr std::uint32_t kRedPixel = 0xff0000ff, kGreenPixel = 0xff00ff00, kBluePixel = 0xffff0000;

class DrawingTest : public test::GpuTest {
 protected:
  // Two rectangles, of the left half at depth 0.5 and of the whole picture at depth 0.7, and some vertices
  // before each that no index means.
  DrawingTest() {
    const float positions[] = {9, 9, 9, -1, -1, .5F, 0, -1, .5F, 0, 1, .5F, -1, 1, .5F,
                               9, 9, 9, -1, -1, .7F, 1, -1, .7F, 1, 1, .7F, -1, 1, .7F};
    const std::uint32_t indices[] = {7, 1, 2, 3, 1, 3, 4};
    positions_ = device().make_vertex_buffer("positions", sizeof positions);
    indices_ = device().make_vertex_buffer("indices", sizeof indices);
    device().upload(positions_, 0, std::as_bytes(std::span(positions)));
    device().upload(indices_, 0, std::as_bytes(std::span(indices)));
    constexpr gpu::VertexFormat kInputs[] = {gpu::VertexFormat::kFloat3};
    pipeline_ = device().make_raster_pipeline("flat", {.vertex = flat_vert_spv,
                                                       .fragment = flat_frag_spv,
                                                       .inputs = kInputs,
                                                       .push_constant_bytes = sizeof(Color)});
    target_ = device().make_render_target("target", kSize, kSize);
    inputs_.emplace_back(positions_);
  }

  gpu::Recorder::Draw left() const {
    return {.inputs = inputs_, .indices = &indices_, .first_index = 1, .index_count = 6, .first_vertex = 0};
  }
  gpu::Recorder::Draw whole() const {
    return {.inputs = inputs_, .indices = &indices_, .first_index = 1, .index_count = 6, .first_vertex = 5};
  }

  void render(gpu::Recorder& recorder, const gpu::Recorder::Draw& draw, const Color& color) {
    recorder.begin_rendering(target_);
    recorder.draw(pipeline_, color, draw);
    recorder.end_rendering();
  }

  std::vector<std::uint32_t> pixels(gpu::Recorder& recorder) {
    const gpu::Array<std::uint32_t> picture(device(), "picture", kSize * kSize);
    recorder.copy_color(target_, picture.buffer());
    recorder.submit_and_wait();
    return picture.download(device());
  }

  gpu::Buffer positions_, indices_;
  gpu::RasterPipeline pipeline_;
  gpu::RenderTarget target_;
  std::vector<gpu::BufferRange> inputs_;
};

TEST_F(DrawingTest, NearerTrianglesStayInFrontAcrossRenderings) {
  gpu::Recorder recorder(device());
  recorder.clear(target_, kBlue);
  render(recorder, left(), kRed);
  std::vector<std::uint32_t> picture = pixels(recorder);
  for (std::uint32_t i = 0; i < picture.size(); ++i)
    ASSERT_EQ(picture[i], i % kSize < kSize / 2 ? kRedPixel : kBluePixel) << i;
  render(recorder, whole(), kGreen);
  picture = pixels(recorder);
  for (std::uint32_t i = 0; i < picture.size(); ++i)
    ASSERT_EQ(picture[i], i % kSize < kSize / 2 ? kRedPixel : kGreenPixel) << i;
  recorder.clear(target_, kBlue);
  render(recorder, whole(), kGreen);
  EXPECT_THAT(pixels(recorder), testing::Each(kGreenPixel)) << "clearing must clear the depths, too";
}

TEST_F(DrawingTest, NothingIsDrawnOfNoIndices) {
  gpu::Recorder recorder(device());
  recorder.clear(target_, kBlue);
  gpu::Recorder::Draw nothing = whole();
  nothing.index_count = 0;
  render(recorder, nothing, kGreen);
  EXPECT_THAT(pixels(recorder), testing::Each(kBluePixel));
}

TEST_F(DrawingTest, InvocationsAreCountedWhereAskedFor) {
  if (!device().info().counts_invocations) GTEST_SKIP() << "the device does not count";
  gpu::Recorder recorder(device());
  recorder.clear(target_, kBlue);
  recorder.count_invocations();
  for (int i = 0; i < 300; ++i) render(recorder, i % 2 == 0 ? left() : whole(), kRed);
  recorder.submit_and_wait();
  ASSERT_EQ(recorder.draw_counts().size(), 300U);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_GE(recorder.draw_counts()[i].vertex_invocations, 4U);
    EXPECT_LE(recorder.draw_counts()[i].vertex_invocations, 6U);
  }
  EXPECT_GE(recorder.draw_counts()[0].fragment_invocations, kSize * kSize / 2);
  recorder.clear(target_, kBlue);
  recorder.submit_and_wait();
  EXPECT_TRUE(recorder.draw_counts().empty());
}

TEST_F(DrawingTest, EveryRenderingIsTimedWhenProfiling) {
  if (device().info().timestamp_bits == 0) GTEST_SKIP() << "the device has no timestamps";
  gpu::Recorder recorder(device(), true);
  recorder.clear(target_, kBlue);
  for (int i = 0; i < 260; ++i) render(recorder, whole(), kRed);
  recorder.submit_and_wait();
  ASSERT_EQ(recorder.timings().size(), 260U);
  for (const auto& timing : recorder.timings()) {
    EXPECT_EQ(timing.kernel, "target");
    EXPECT_GT(timing.nanoseconds.value(), 0);
  }
  gpu::faults(device()).clock_runs_backwards = true;
  render(recorder, whole(), kRed);
  recorder.submit_and_wait();
  gpu::faults(device()) = {};
  EXPECT_EQ(recorder.timings().at(0).nanoseconds, std::nullopt);
}

TEST(ElapsedTicks, WrapOnceAndNeverRunBackwards) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(gpu::elapsed_ticks(10, 10, 36), 0U);
  EXPECT_EQ(gpu::elapsed_ticks(10, 25, 36), 15U);
  EXPECT_EQ(gpu::elapsed_ticks((1ULL << 36) - 5, 7, 36), 12U);
  EXPECT_EQ(gpu::elapsed_ticks(kMost - 4, 7, 64), 12U);
  EXPECT_EQ(gpu::elapsed_ticks(25, 10, 36), std::nullopt);
  EXPECT_EQ(gpu::elapsed_ticks(25, 10, 64), std::nullopt);
  EXPECT_EQ(gpu::elapsed_ticks(kMost, kMost & ((1ULL << 36) - 1), 36), 0U) << "upper bits mean nothing";
}

TEST_F(DrawingTest, WrongUseIsRefused) {
  gpu::Recorder recorder(device());
  EXPECT_THAT(logic_error_of([&] { recorder.draw(pipeline_, kRed, left()); }), HasSubstr("begin_rendering"));
  EXPECT_THAT(logic_error_of([&] { recorder.end_rendering(); }), HasSubstr("begin_rendering"));
  recorder.clear(target_, kBlue);
  recorder.begin_rendering(target_);
  EXPECT_THAT(logic_error_of([&] { recorder.draw(pipeline_, gpu::NoParams{}, left()); }),
              HasSubstr("0 bytes of parameters, the shaders have 16"));
  gpu::Recorder::Draw wrong = left();
  wrong.inputs = {};
  EXPECT_THAT(logic_error_of([&] { recorder.draw(pipeline_, kRed, wrong); }), HasSubstr("got 0 buffers"));
  wrong = left();
  wrong.first_index = 7;
  EXPECT_THAT(logic_error_of([&] { recorder.draw(pipeline_, kRed, wrong); }), HasSubstr("indices 7 to 13"));
  EXPECT_THAT(logic_error_of([&] { recorder.fill(gpu::Array<std::uint32_t>(device(), "a", 1), 0); }),
              HasSubstr("end_rendering"));
  EXPECT_THAT(logic_error_of([&] { recorder.submit_and_wait(); }), HasSubstr("end_rendering"));
  // What was recorded is gone, and the recorder is as good as new.
  recorder.clear(target_, kBlue);
  render(recorder, whole(), kGreen);
  EXPECT_THAT(pixels(recorder), testing::Each(kGreenPixel));
  const gpu::Array<std::uint32_t> small(device(), "small", kSize * kSize - 1);
  EXPECT_THAT(logic_error_of([&] { recorder.copy_color(target_, small.buffer(), 16); }),
              HasSubstr("no room"));
  recorder.submit_and_wait();
}

TEST_F(DrawingTest, PicturesBeyondTheDeviceAreErrors) {
  EXPECT_THROW(device().make_render_target("none", 0, 5), gpu::Error);
  EXPECT_THROW(device().make_render_target("wide", 1'000'000, 5), gpu::Error);
  for (const std::uint32_t allocations : {0U, 1U}) {
    gpu::faults(device()).allocations_until_failure = allocations;
    EXPECT_THROW(device().make_render_target("refused", 64, 64), gpu::OutOfMemory);
  }
}

TEST_F(DrawingTest, VertexBuffersMayBeLargerThanStorageBuffers) {
  const std::uint64_t bytes = device().info().max_storage_buffer_bytes + 16;
  if (bytes > device().info().max_allocation_bytes || bytes > std::uint64_t{1} << 28)
    GTEST_SKIP() << "storage buffers may be as large as any";
  EXPECT_THROW(device().make_buffer("storage", bytes), gpu::OutOfMemory);
  EXPECT_EQ(device().make_vertex_buffer("vertices", bytes).bytes(), bytes);
}

}  // namespace
}  // namespace scene_analyzer
