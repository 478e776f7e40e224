// Jobs that nobody waits for, devices that fail, and an executor that ends before its jobs.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <future>
#include <system_error>

#include "gpu/error.h"
#include "service/executor_fixture.h"

namespace scene_analyzer::service {
namespace {

using analysis::Metric;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

constexpr double kImported = 0.2;  // of a job's progress

TEST_F(ExecutorTest, CancelledInTheImportOrBeforeIt) {
  const auto executor = this->executor({.import_workers = 1});
  {
    const Misbehaviour misbehaviour("hang");
    Order endless = order(cube_);
    endless.options.import_limits.seconds = 1e6;
    const auto importing = executor->submit(endless);
    ASSERT_TRUE(comes_true([&] { return executor->depth().waiting == 0; }));
    const auto waiting = executor->submit(endless);
    EXPECT_EQ(executor->depth().waiting, 1U);
    waiting->cancel();
    EXPECT_FALSE(importing->is_done());
    importing->cancel();
    EXPECT_THAT(ending(*importing), StartsWith("cancelled: "));
    EXPECT_THAT(ending(*waiting), StartsWith("cancelled: "));
  }
  EXPECT_EQ(ending(*executor->submit(order(cube_))), "");
  EXPECT_THAT(errors(), IsEmpty());
}

TEST_F(ExecutorTest, CancelledWhileItIsMeasured) {
  options_.parameters.start_searches = UINT64_MAX;
  const auto endless = order(write(test_meshes::heightfield(150, 5, 3), "hills.obj"));
  options_.parameters.start_searches = 1;
  const auto executor = this->executor();
  const auto job = executor->submit(endless);
  ASSERT_TRUE(comes_true([&] {
    const Job::State state = job->wait(UINT64_MAX, std::chrono::steady_clock::now());
    return state.done || state.fraction > kImported;
  }));
  ASSERT_FALSE(job->is_done()) << "it was to take long";
  job->cancel();
  EXPECT_THAT(ending(*job), StartsWith("cancelled: "));
  EXPECT_EQ(ending(*executor->submit(order(cube_))), "");
  EXPECT_THAT(errors(), IsEmpty());
}

TEST_F(ExecutorTest, OneOfSeveralThatAreMeasuredTogetherIsCancelled) {
  const pipeline::Outcome expected = alone(cube_, options_);
  Gate begun;
  std::atomic<bool> asked = false;
  const auto executor = this->executor({.import_workers = 2}, [&]() -> gpu::Device& {
    asked = true;
    begun.wait();
    return device();
  });
  // The first waits for the device, the others go together then.
  std::vector<std::shared_ptr<Job>> jobs = {executor->submit(order(cube_))};
  ASSERT_TRUE(comes_true([&] { return asked.load(); }));
  for (int i = 0; i < 4; ++i) jobs.push_back(executor->submit(order(cube_)));
  ASSERT_TRUE(comes_true([&] { return executor->depth().ready == 4; }));
  jobs[3]->cancel();
  begun.open();
  for (const std::size_t i : {0U, 1U, 2U, 4U}) expect_as_alone(*jobs[i], expected);
  EXPECT_THAT(ending(*jobs[3]), StartsWith("cancelled: "));
}

TEST_F(ExecutorTest, WithoutADeviceJobsAreRefusedAndTheReasonIsLogged) {
  const auto executor = this->executor({}, []() -> gpu::Device& { throw gpu::NoDevice("no device at all"); });
  EXPECT_THROW(executor->device(), gpu::NoDevice);
  EXPECT_EQ(ending(*executor->submit(order(cube_))), "unavailable: no device at all");
  Order timed = order(cube_);
  timed.options.metrics.set(index_of(Metric::kRenderingTime));
  EXPECT_EQ(ending(*executor->submit(std::move(timed))), "unavailable: no device at all");
  EXPECT_THAT(errors(), ElementsAre("no device at all", "no device at all"));
}

TEST_F(ExecutorTest, DefectsAreLoggedAndNotToldToClients) {
  bool is_defect = true;
  const auto executor = this->executor({}, [&]() -> gpu::Device& {
    if (std::exchange(is_defect, false)) throw std::logic_error("a secret of the program");
    return device();
  });
  EXPECT_THAT(ending(*executor->submit(order(cube_))),
              AllOf(StartsWith("internal: "), testing::Not(HasSubstr("secret"))));
  EXPECT_THAT(errors(), ElementsAre("a secret of the program"));
  EXPECT_EQ(ending(*executor->submit(order(cube_))), "");
}

// Lost twice: with a single job, whose fault it was, and with several, of which nobody knows.
TEST_F(ExecutorTest, AfterALostDeviceThoseAreTriedAloneWhoseFaultItMayNotBe) {
  const pipeline::Outcome expected = alone(cube_, options_);
  Gate begun;
  std::atomic<int> asked = 0;
  const auto executor = this->executor({.import_workers = 2}, [&]() -> gpu::Device& {
    if (++asked == 1) begun.wait();
    if (asked <= 2) throw gpu::DeviceLost("The device was lost.");
    return device();
  });
  const auto first = executor->submit(order(cube_));
  ASSERT_TRUE(comes_true([&] { return asked == 1; }));
  std::vector<std::shared_ptr<Job>> jobs;
  for (int i = 0; i < 3; ++i) jobs.push_back(executor->submit(order(cube_)));
  ASSERT_TRUE(comes_true([&] { return executor->depth().ready == 3; }));
  begun.open();
  EXPECT_THAT(ending(*first), AllOf(StartsWith("unavailable: The device was lost."), HasSubstr("try again")));
  for (const auto& job : jobs) expect_as_alone(*job, expected);
  EXPECT_EQ(asked, 3);
  EXPECT_THAT(errors(), SizeIs(2));
}

TEST_F(ExecutorTest, LostAgainAloneAJobIsRefused) {
  Gate begun;
  std::atomic<int> asked = 0;
  const auto executor = this->executor({.import_workers = 2}, [&]() -> gpu::Device& {
    if (++asked == 1) begun.wait();
    throw gpu::DeviceLost("The device was lost.");
  });
  std::vector<std::shared_ptr<Job>> jobs = {executor->submit(order(cube_))};
  ASSERT_TRUE(comes_true([&] { return asked == 1; }));
  for (const std::uint32_t size : {3U, 4U, 5U})
    jobs.push_back(
        executor->submit(order(write(test_meshes::heightfield(size, 1, 1), std::to_string(size) + ".obj"))));
  ASSERT_TRUE(comes_true([&] { return executor->depth().ready == 3; }));
  begun.open();
  for (const auto& job : jobs) EXPECT_THAT(ending(*job), StartsWith("unavailable: "));
  EXPECT_EQ(asked, 5) << "the first, the three together, and each of them alone";
}

TEST_F(ExecutorTest, AnAssetThatTheDeviceIsLostWithIsTriedTwice) {
  bool is_lost = true;
  int asked = 0;
  const auto executor = this->executor({}, [&]() -> gpu::Device& {
    ++asked;
    if (is_lost) throw gpu::DeviceLost("The device was lost.");
    return device();
  });
  for (int i = 0; i < 2; ++i)
    EXPECT_THAT(ending(*executor->submit(order(cube_))), StartsWith("unavailable: "));
  const mesh::AssetSource renamed(write(test_meshes::cube(), "again.obj"), "again.obj");
  EXPECT_THAT(ending(*executor->submit(order(renamed))),
              AllOf(StartsWith("too_large: again.obj: "), HasSubstr("lost 2 times")));
  EXPECT_EQ(asked, 2);
  is_lost = false;
  EXPECT_EQ(ending(*executor->submit(order(write(test_meshes::heightfield(3, 1, 1), "hills.obj")))), "");
}

// Pictures are drawn one by one; all of them are imported before the first is.
TEST_F(ExecutorTest, ManyOfOneAssetThatTheDeviceIsLostWithLoseItTwice) {
  Gate begun;
  std::atomic<int> asked = 0;
  const auto executor = this->executor({.import_workers = 2}, [&]() -> gpu::Device& {
    if (++asked == 1) begun.wait();
    throw gpu::DeviceLost("The device was lost.");
  });
  Order drawn = order(cube_);
  drawn.picture = picture_order(64, 64);
  std::vector<std::shared_ptr<Job>> jobs = {executor->submit(drawn)};
  ASSERT_TRUE(comes_true([&] { return asked == 1; }));
  for (int i = 0; i < 4; ++i) jobs.push_back(executor->submit(drawn));
  ASSERT_TRUE(comes_true([&] { return executor->depth().ready == 4; }));
  begun.open();
  std::vector<std::string> endings;
  for (const auto& job : jobs) endings.push_back(ending(*job));
  EXPECT_THAT(endings.front(), StartsWith("unavailable: "));
  EXPECT_THAT(endings, Contains(StartsWith("unavailable: ")).Times(2));
  EXPECT_THAT(endings, Contains(StartsWith("too_large: ")).Times(3));
  EXPECT_EQ(asked, 2);
}

// Each thread's stack takes 8 MiB of addresses.
TEST_F(ExecutorTest, ThreadsThatTheSystemDoesNotStartAreAnError) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer has reserved more addresses than could be allowed";
#endif
  const int child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::ifstream statm("/proc/self/statm");
    rlim_t pages = 0;
    statm >> pages;
    const rlim_t most = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (256U << 20);
    const rlimit limit{most, most};
    if (::setrlimit(RLIMIT_AS, &limit) != 0) ::_exit(3);
    try {
      executor({.import_workers = 1024});
      ::_exit(4);
    } catch (const std::system_error&) {
      ::_exit(0);
    } catch (...) {  // else GoogleTest would go on in this process
      ::_exit(5);
    }
  }
  int status = 0;
  if (!comes_true([&] { return ::waitpid(child, &status, WNOHANG) == child; })) {
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    FAIL() << "it hangs";
  }
  EXPECT_EQ(status, 0);
}

// The imports that are under way would take for ever: they have to be ended too.
TEST_F(ExecutorTest, EndingItAnswersAllThatWait) {
  std::vector<std::shared_ptr<Job>> jobs;
  const Misbehaviour misbehaviour("hang");
  Order endless = order(cube_);
  endless.options.import_limits.seconds = 1e6;
  {
    const auto executor = this->executor({.import_workers = 2});
    for (int i = 0; i < 6; ++i) jobs.push_back(executor->submit(endless));
    ASSERT_TRUE(comes_true([&] { return executor->depth().waiting == 4; }));
  }
  for (const auto& job : jobs) {
    ASSERT_TRUE(job->is_done());
    EXPECT_EQ(ending(*job), "unavailable: the service is shutting down");
  }
}

TEST_F(ExecutorTest, EndingItAnswersAllThatAreReadyOrOnTheDevice) {
  std::vector<std::shared_ptr<Job>> jobs;
  Gate ending_begun;
  std::atomic<bool> asked = false;
  auto executor = this->executor({.import_workers = 2}, [&]() -> gpu::Device& {
    asked = true;
    ending_begun.wait();
    return device();
  });
  jobs.push_back(executor->submit(order(cube_)));
  ASSERT_TRUE(comes_true([&] { return asked.load(); }));
  for (int i = 0; i < 3; ++i) jobs.push_back(executor->submit(order(cube_)));
  ASSERT_TRUE(comes_true([&] { return executor->depth().ready == 3; }));
  auto ended = std::async(std::launch::async, [&] { executor.reset(); });
  EXPECT_EQ(ending(*jobs[1]), "unavailable: the service is shutting down")
      << "before the device's thread ends";
  ending_begun.open();
  ended.get();
  for (const auto& job : jobs) {
    ASSERT_TRUE(job->is_done());
    EXPECT_NE(ending(*job), "never done");
  }
}

// At whatever step of theirs.
TEST_F(ExecutorTest, EndingItAtAnyMomentAnswersEveryJob) {
  for (int round = 0; round < 30; ++round) {
    std::vector<std::shared_ptr<Job>> jobs;
    {
      const auto executor = this->executor({.import_workers = 2});
      for (int i = 0; i < 4; ++i) jobs.push_back(executor->submit(order(cube_)));
      const auto& watched = jobs[static_cast<std::size_t>(round) % jobs.size()];
      const auto enough = static_cast<std::uint64_t>(round) / 4;
      ASSERT_TRUE(comes_true([&] {
        const Job::State state = watched->wait(UINT64_MAX, std::chrono::steady_clock::now());
        return state.done || state.version >= enough;
      }));
    }
    for (const auto& job : jobs) ASSERT_TRUE(job->is_done()) << "round " << round;
  }
}

}  // namespace
}  // namespace scene_analyzer::service
