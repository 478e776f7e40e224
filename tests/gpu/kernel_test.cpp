#include "gpu/kernel.h"

#include "gpu/error.h"
#include "gpu/recorder.h"
#include "parameters.h"
#include "support/gpu_test.h"
// Generated:
#include "echo_params.spv.h"
#include "gap_in_bindings.spv.h"
#include "write_constants.spv.h"
#include "write_index.spv.h"

namespace scene_analyzer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class KernelTest : public test::GpuTest {
 protected:
  std::vector<std::uint32_t> seen_by(const gpu::Kernel& kernel) {
    const gpu::Array<std::uint32_t> seen(device(), "seen", 3);
    gpu::Recorder recorder(device());
    recorder.run(kernel, 1, gpu::NoParams{}, {seen});
    recorder.submit_and_wait();
    return seen.download(device());
  }
  std::string error_of(std::span<const std::uint32_t> words, std::span<const std::uint32_t> constants = {}) {
    try {
      device().make_kernel("broken", words, constants);
    } catch (const gpu::Error& error) {
      return error.what();
    }
    return "no gpu::Error";
  }
};

TEST_F(KernelTest, ReadsItsShapeFromTheShader) {
  const gpu::Kernel kernel = device().make_kernel("write_index", write_index_spv);
  EXPECT_EQ(kernel.name(), "write_index");
  EXPECT_EQ(kernel.local_size(), 64u);
  EXPECT_EQ(kernel.buffer_count(), 2u);
  EXPECT_EQ(kernel.push_constant_bytes(), sizeof(interface::gpu_test::WriteIndexParams));
}

TEST_F(KernelTest, SpecialisationReachesShaderAndLocalSize) {
  const std::array<std::uint32_t, 3> constants{128, 11, 12};
  const gpu::Kernel kernel = device().make_kernel("constants", write_constants_spv, constants);
  EXPECT_EQ(kernel.local_size(), 128u);
  EXPECT_THAT(seen_by(kernel), ElementsAre(128, 11, 12));
}

TEST_F(KernelTest, ConstantsWithoutValueKeepTheirDefault) {
  const std::array<std::uint32_t, 2> constants{32, 11};
  EXPECT_THAT(seen_by(device().make_kernel("constants", write_constants_spv, constants)),
              ElementsAre(32, 11, 6));
}

TEST_F(KernelTest, ParametersArriveAsTheHostSentThem) {
  const gpu::Kernel kernel = device().make_kernel("echo", echo_params_spv);
  const gpu::Array<double> sums(device(), "sums", 5);
  gpu::Recorder recorder(device());
  interface::gpu_test::WideParams params {};
  params.direction = {1, 2, 4};
  params.count = 4000000000u;
  params.origin = {0.5, 0.25, 1e-9};
  params.seed = std::uint64_t{1} << 52;
  params.scale = 0.125f;
  recorder.run(kernel, 1, params, {sums});
  recorder.submit_and_wait();
  EXPECT_THAT(sums.download(device()), ElementsAre(7, 4e9, 0.75 + 1e-9, 4503599627370496.0, 0.125));
}

TEST_F(KernelTest, RefusesWhatIsNoUsableShader) {
  EXPECT_THAT(error_of({}), HasSubstr("kernel 'broken': not a SPIR-V module"));
  EXPECT_THAT(error_of(gap_in_bindings_spv), HasSubstr("no storage buffer has binding 1"));
  const std::array<std::uint32_t, 1> none{0}, many{1u << 30};
  EXPECT_THAT(error_of(write_constants_spv, none), HasSubstr("a workgroup has 0 threads"));
  EXPECT_THAT(error_of(write_constants_spv, many), HasSubstr("a workgroup has 1073741824 threads"));
}

}  // namespace
}  // namespace scene_analyzer
