// The promise that a silent run is a sound one: mistakes made through the native door must be heard.
#include "gpu/native.h"
#include "support/gpu_test.h"

namespace scene_analyzer {
namespace {

using testing::Contains;
using testing::HasSubstr;

class ValidationTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::device_options().validation) GTEST_SKIP() << "SCENE_ANALYZER_VALIDATION=0";
    device_ = std::make_unique<gpu::Device>(test::device_options());
  }
  std::unique_ptr<gpu::Device> device_;
};

TEST_F(ValidationTest, HearsAWrongArgument) {
  const auto& commands = device_->native().make_commands();
  commands.begin({});
  const gpu::Buffer buffer = device_->make_buffer("buffer", 64);
  commands.fillBuffer(*buffer.impl().buffer, 2, 4, 0);  // the offset must be a multiple of 4
  commands.end();
  EXPECT_THAT(device_->take_validation_messages(), Contains(HasSubstr("VUID-vkCmdFillBuffer-dstOffset")));
  EXPECT_THAT(device_->take_validation_messages(), testing::IsEmpty());  // taken is taken
}

TEST_F(ValidationTest, HearsAMissingBarrier) {
  const gpu::Buffer buffer = device_->make_buffer("buffer", 64);
  const auto& commands = device_->native().make_commands();
  commands.begin({});
  commands.fillBuffer(*buffer.impl().buffer, 0, 64, 0);
  commands.fillBuffer(*buffer.impl().buffer, 0, 64, 1);
  commands.end();
  EXPECT_THAT(device_->take_validation_messages(), Contains(HasSubstr("SYNC-HAZARD-WRITE-AFTER-WRITE")));
}

TEST_F(ValidationTest, HearsNothingFromASoundRun) {
  const gpu::Buffer buffer = device_->make_buffer("buffer", 64);
  gpu::Recorder recorder(*device_);
  recorder.fill(buffer, 0);
  recorder.fill(buffer, 1);
  recorder.submit_and_wait();
  EXPECT_THAT(device_->take_validation_messages(), testing::IsEmpty());
}

}  // namespace
}  // namespace scene_analyzer
