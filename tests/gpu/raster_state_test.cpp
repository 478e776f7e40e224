// What pipelines can do besides opaque triangles on one sample: smooth edges, reversed depths, translucency,
// textures, buffers, vertices without indices.
#include <array>
#include <cstdint>
#include <set>

#include "gpu/error.h"
#include "gpu/faults.h"
#include "gpu/recorder.h"
#include "logic_error.h"
#include "support/gpu_test.h"
// Generated:
#include "flat_frag.spv.h"
#include "flat_vert.spv.h"
#include "textured_frag.spv.h"

namespace scene_analyzer {
namespace {

using testing::Each;
using testing::HasSubstr;

constexpr std::uint32_t kSize = 16;  // pixels each way
using Color = std::array<float, 4>;
constexpr Color kRed = {1, 0, 0, 1}, kBlue = {0, 0, 1, 1};
constexpr std::uint32_t kRedPixel = 0xff0000ff, kBluePixel = 0xffff0000;
constexpr gpu::VertexFormat kInputs[] = {gpu::VertexFormat::kFloat3};

std::uint32_t red(std::uint32_t pixel) {
  return pixel & 0xff;
}
std::uint32_t green(std::uint32_t pixel) {
  return pixel >> 8 & 0xff;
}
std::uint32_t blue(std::uint32_t pixel) {
  return pixel >> 16 & 0xff;
}

class RasterStateTest : public test::GpuTest {
 protected:
  // Triangles without indices: two that fill the picture at depth 0.5, two at 0.7, and one of the half below
  // the diagonal.
  RasterStateTest() {
    const auto rectangle = [&](float depth) {
      for (const auto& [x, y] :
           {std::pair{-1.F, -1.F}, {1.F, -1.F}, {1.F, 1.F}, {-1.F, -1.F}, {1.F, 1.F}, {-1.F, 1.F}})
        vertices_.insert(vertices_.end(), {x, y, depth});
    };
    rectangle(.5F);
    rectangle(.7F);
    vertices_.insert(vertices_.end(), {-1, -1, .5F, -1, 1, .5F, 1, 1, .5F});
    positions_ = device().make_vertex_buffer("positions", vertices_.size() * sizeof(float));
    device().upload(positions_, 0, std::as_bytes(std::span(vertices_)));
    inputs_.emplace_back(positions_);
  }

  gpu::RasterPipeline flat(const gpu::RasterState& state) {
    return device().make_raster_pipeline("flat", {.vertex = flat_vert_spv,
                                                  .fragment = flat_frag_spv,
                                                  .inputs = kInputs,
                                                  .push_constant_bytes = sizeof(Color),
                                                  .state = state});
  }
  gpu::RasterPipeline textured() {
    return device().make_raster_pipeline("textured", {.vertex = flat_vert_spv,
                                                      .fragment = textured_frag_spv,
                                                      .inputs = kInputs,
                                                      .push_constant_bytes = sizeof(Color),
                                                      .reads_texture = true,
                                                      .buffer_count = 1});
  }

  gpu::Recorder::Draw near_rectangle() const { return {.inputs = inputs_, .index_count = 6}; }
  gpu::Recorder::Draw far_rectangle() const {
    return {.inputs = inputs_, .index_count = 6, .first_vertex = 6};
  }
  gpu::Recorder::Draw half() const { return {.inputs = inputs_, .index_count = 3, .first_vertex = 12}; }

  std::vector<std::uint32_t> pixels(gpu::Recorder& recorder, const gpu::RenderTarget& target) {
    const gpu::Array<std::uint32_t> picture(device(), "picture", kSize * kSize);
    recorder.copy_color(target, picture.buffer());
    recorder.submit_and_wait();
    return picture.download(device());
  }

  // One rendering over blue.
  std::vector<std::uint32_t> picture_of(const gpu::RasterPipeline& pipeline, const Color& params,
                                        const gpu::Recorder::Draw& draw, std::uint32_t samples = 1) {
    const gpu::RenderTarget target = device().make_render_target("target", kSize, kSize, samples);
    gpu::Recorder recorder(device());
    recorder.clear(target, kBlue);
    recorder.begin_rendering(target);
    recorder.draw(pipeline, params, draw);
    recorder.end_rendering();
    return pixels(recorder, target);
  }

  std::vector<float> vertices_;
  gpu::Buffer positions_;
  std::vector<gpu::BufferRange> inputs_;
};

TEST_F(RasterStateTest, SeveralSamplesSmoothEdges) {
  const std::vector<std::uint32_t> hard = picture_of(flat({}), kRed, half());
  EXPECT_EQ(std::set<std::uint32_t>(hard.begin(), hard.end()), (std::set{kRedPixel, kBluePixel}));
  const std::vector<std::uint32_t> smooth = picture_of(flat({.samples = 4}), kRed, half(), 4);
  for (std::uint32_t y = 0; y < kSize; ++y)
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const std::uint32_t pixel = smooth[y * kSize + x];
      EXPECT_NEAR(red(pixel) + blue(pixel), 255, 1);
      // Two of four samples of a pixel on the diagonal lie beyond it.
      EXPECT_NEAR(red(pixel), x < y ? 255 : x > y ? 0 : 127.5, x == y ? 1 : 0);
    }
}

TEST_F(RasterStateTest, ASecondRenderingGoesOnWithAllSamples) {
  const gpu::RasterPipeline pipeline = flat({.samples = 4});
  const gpu::RenderTarget target = device().make_render_target("target", kSize, kSize, 4);
  gpu::Recorder recorder(device());
  recorder.clear(target, kBlue);
  for (const auto& [color, draw] : {std::pair{kRed, half()}, {Color{0, 1, 0, 1}, far_rectangle()}}) {
    recorder.begin_rendering(target);
    recorder.draw(pipeline, color, draw);
    recorder.end_rendering();
    pixels(recorder, target);
  }
  const std::vector<std::uint32_t> picture = pixels(recorder, target);
  EXPECT_EQ(picture[kSize], kRedPixel) << "the nearer half stays";
  EXPECT_NEAR(green(picture[0]), 127.5, 1) << "the other samples of the diagonal are those behind";
  EXPECT_EQ(green(picture[1]), 255U);
}

TEST_F(RasterStateTest, ReversedDepthsKeepWhatIsGreater) {
  const gpu::RasterPipeline pipeline = flat({.reversed_depth = true});
  const gpu::RenderTarget target = device().make_render_target("target", kSize, kSize);
  gpu::Recorder recorder(device());
  recorder.clear(target, kBlue, 0);
  recorder.begin_rendering(target);
  recorder.draw(pipeline, kRed, far_rectangle());
  recorder.draw(pipeline, Color{0, 1, 0, 1}, near_rectangle());
  recorder.end_rendering();
  EXPECT_THAT(pixels(recorder, target), Each(kRedPixel));
}

TEST_F(RasterStateTest, TranslucentTrianglesHideNothing) {
  const gpu::RasterPipeline opaque = flat({}), glass = flat({.translucent = true});
  const gpu::RenderTarget target = device().make_render_target("target", kSize, kSize);
  gpu::Recorder recorder(device());
  recorder.clear(target, kBlue);
  recorder.begin_rendering(target);
  recorder.draw(glass, Color{1, 0, 0, .25F}, near_rectangle());
  recorder.end_rendering();
  std::vector<std::uint32_t> picture = pixels(recorder, target);
  EXPECT_NEAR(red(picture[0]), 64, 1);
  EXPECT_NEAR(blue(picture[0]), 191, 1);
  EXPECT_EQ(picture[0] >> 24, 255U) << "what is opaque stays opaque";
  recorder.begin_rendering(target);
  recorder.draw(opaque, Color{0, 1, 0, 1}, far_rectangle());
  recorder.draw(glass, Color{1, 0, 0, .25F}, near_rectangle());
  recorder.end_rendering();
  picture = pixels(recorder, target);
  EXPECT_NEAR(green(picture[0]), 191, 1) << "the glass left no depth behind";
  recorder.begin_rendering(target);
  recorder.draw(opaque, kBlue, near_rectangle());
  recorder.draw(glass, Color{1, 0, 0, .25F}, far_rectangle());
  recorder.end_rendering();
  EXPECT_THAT(pixels(recorder, target), Each(kBluePixel)) << "glass behind an opaque triangle is hidden";
}

TEST_F(RasterStateTest, TexturesAreFilteredAndRepeated) {
  if (!device().info().numbers_triangles) GTEST_SKIP() << "the device does not number triangles";
  // Green 0, 60, 120, 180 from the left, 40 more in the lower row.
  std::vector<std::uint8_t> rgba;
  for (const int row : {0, 1})
    for (const int column : {0, 1, 2, 3})
      rgba.insert(rgba.end(), {9, static_cast<std::uint8_t>(60 * column + 40 * row), 9, 255});
  const gpu::Texture texture = device().make_texture("steps", 4, 2, rgba);
  const gpu::Array<float> values(device(), "values", 2);
  values.upload(device(), std::array{0.2F, 0.6F});
  const std::array buffers{gpu::BufferRange(values)};
  const gpu::RasterPipeline pipeline = textured();
  gpu::Recorder::Draw draw = near_rectangle();
  draw.texture = &texture;
  draw.buffers = buffers;
  const auto sample = [&](float u, float v, float level) {
    return picture_of(pipeline, Color{u, v, level, 0}, draw);
  };
  EXPECT_EQ(green(sample(.125F, .25F, 0)[0]), 0U);
  EXPECT_EQ(green(sample(.375F, .75F, 0)[0]), 100U);
  EXPECT_EQ(green(sample(-.625F, 3.75F, 0)[0]), 100U) << "repeated";
  EXPECT_NEAR(green(sample(.25F, .25F, 0)[0]), 30, 1) << "between the first two";
  EXPECT_EQ(green(sample(.25F, .5F, 1)[0]), 50U) << "the first 2 x 2";
  EXPECT_EQ(green(sample(.5F, .5F, 2)[0]), 110U) << "all";
  const std::vector<std::uint32_t> picture = sample(.125F, .25F, 0);
  EXPECT_EQ(red(picture[1]), 51U) << "the first triangle's value";
  EXPECT_EQ(red(picture[kSize * (kSize - 1)]), 153U) << "the second one's";
}

TEST_F(RasterStateTest, ASingleElementServesAllVertices) {
  const gpu::RasterPipeline pipeline = flat({});
  gpu::Recorder::Draw draw = near_rectangle();
  draw.single_inputs = 1;
  EXPECT_THAT(picture_of(pipeline, kRed, draw), Each(kBluePixel)) << "all corners in one place";
  EXPECT_THAT(picture_of(pipeline, kRed, near_rectangle()), Each(kRedPixel));
}

TEST_F(RasterStateTest, WrongUseIsRefused) {
  EXPECT_THROW(device().make_render_target("odd", kSize, kSize, 3), gpu::Error);
  EXPECT_THROW(device().make_render_target("none", kSize, kSize, 0), gpu::Error);
  const std::array<std::uint8_t, 4> white = {255, 255, 255, 255};
  EXPECT_THROW(device().make_texture("none", 0, 1, white), gpu::Error);
  EXPECT_THROW(device().make_texture("wide", 1'000'000, 1, white), gpu::Error);
  EXPECT_THAT(logic_error_of([&] { device().make_texture("short", 2, 1, white); }), HasSubstr("got 4 bytes"));
  for (const std::uint32_t allocations : {0U, 1U}) {
    gpu::faults(device()).allocations_until_failure = allocations;
    EXPECT_THROW(device().make_texture("refused", 1, 1, white), gpu::OutOfMemory);
  }
  gpu::faults(device()) = {};
  EXPECT_THAT(logic_error_of([&] { picture_of(flat({.samples = 4}), kRed, half()); }),
              HasSubstr("4 samples per pixel, picture 'target' has 1"));
  const gpu::Texture texture = device().make_texture("white", 1, 1, white);
  gpu::Recorder::Draw draw = half();
  draw.texture = &texture;
  EXPECT_THAT(logic_error_of([&] { picture_of(flat({}), kRed, draw); }), HasSubstr("reads no texture"));
  if (!device().info().numbers_triangles) return;
  EXPECT_THAT(logic_error_of([&] { picture_of(textured(), kRed, half()); }), HasSubstr("texture is missing"));
  EXPECT_THAT(logic_error_of([&] { picture_of(textured(), kRed, draw); }), HasSubstr("got 0 buffers"));
}

}  // namespace
}  // namespace scene_analyzer
