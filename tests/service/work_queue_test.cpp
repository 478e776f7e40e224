// Which job is imported next, and which go to the device together.
#include "service/work_queue.h"

#include <atomic>

#include "pipeline/pending_analysis.h"
#include "service/executor_fixture.h"

namespace scene_analyzer::service {
namespace {

using analysis::Metric;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

// Long enough for a thread that may go on to do so; one that does later makes a test pass that should not.
constexpr std::chrono::milliseconds kAMoment(50);

class WorkQueueTest : public ExecutorTest {
 protected:
  std::shared_ptr<Job> add(bool is_timed = false) {
    Order one = order(cube_);
    one.options.metrics[index_of(Metric::kRenderingTime)] = is_timed;
    const auto job = std::make_shared<Job>(std::move(one));
    queue_.add(job);
    return job;
  }
  // As an import worker does.
  Imported prepare(const std::shared_ptr<Job>& job, std::uint64_t bytes = 1) {
    return {.job = job,
            .analysis = pipeline_.prepare(job->order().asset, {}, job->options()),
            .picture = {},
            .bytes = bytes,
            .wants_quiet = wants_times(*job)};
  }
  void import(const std::shared_ptr<Job>& job, std::uint64_t bytes = 1) {
    queue_.imported(job, prepare(job, bytes));
  }
  std::vector<std::shared_ptr<Job>> take(std::size_t pending = 0) {
    std::vector<std::shared_ptr<Job>> jobs;
    for (Imported& one : queue_.take_pack(pending)) {
      jobs.push_back(one.job);
      queue_.release(one.bytes);
    }
    return jobs;
  }
  std::future<std::shared_ptr<Job>> next_later() {
    return std::async(std::launch::async, [this] { return queue_.next_to_import(); });
  }
  static bool goes_on(std::future<std::shared_ptr<Job>>& next) {
    return next.wait_for(kAMoment) == std::future_status::ready;
  }

  WorkQueue queue_{100};

 private:
  pipeline::Pipeline pipeline_{{}, device};
};

TEST_F(WorkQueueTest, TheFirstThatCameIsTheFirstThatIsImported) {
  const auto a = add(), b = add();
  EXPECT_EQ(queue_.next_to_import(), a);
  const auto again = std::make_shared<Job>(order(cube_));
  queue_.add(again, true);
  EXPECT_EQ(queue_.depth().waiting, 2U);
  EXPECT_EQ(queue_.next_to_import(), again);
  EXPECT_EQ(queue_.next_to_import(), b);
  EXPECT_EQ(queue_.depth().waiting, 0U);
  queue_.end();
}

TEST_F(WorkQueueTest, WhatIsAlikeGoesTogether) {
  std::vector<std::shared_ptr<Job>> jobs = {add(), add()};
  Order other = order(cube_);
  other.options.parameters.dim = 7;
  jobs.push_back(std::make_shared<Job>(std::move(other)));
  queue_.add(jobs.back());
  jobs.push_back(add());
  for (const auto& job : jobs) {
    EXPECT_EQ(queue_.next_to_import(), job);
    import(job);
  }
  EXPECT_EQ(queue_.depth().ready, 4U);
  EXPECT_THAT(take(), ElementsAre(jobs[0], jobs[1], jobs[3]));
  EXPECT_THAT(take(), ElementsAre(jobs[2]));
}

TEST_F(WorkQueueTest, WithManyPendingNothingIsTaken) {
  const auto job = add();
  import(queue_.next_to_import());
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) EXPECT_THAT(take(4), IsEmpty());
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(20))
      << "it takes a processor to look at searches";
  EXPECT_THAT(take(3), ElementsAre(job));
}

TEST_F(WorkQueueTest, WithManyPendingNothingIsTakenOfWhatComesMeanwhile) {
  std::vector<std::shared_ptr<Job>> jobs;
  std::atomic<bool> is_over = false;
  auto taken = std::async(std::launch::async, [&] {
    std::size_t sum = 0;
    while (!is_over) sum += take(4).size();
    return sum;
  });
  for (int i = 0; i < 20; ++i) {
    jobs.push_back(add());
    import(queue_.next_to_import());
  }
  std::this_thread::sleep_for(kAMoment);
  is_over = true;
  EXPECT_EQ(taken.get(), 0U);
  EXPECT_EQ(take(3), jobs);
}

TEST_F(WorkQueueTest, NoImportBeginsWhileScenesTakeTooMuch) {
  const auto a = add(), b = add();
  import(queue_.next_to_import(), 100);
  auto next = next_later();
  EXPECT_FALSE(goes_on(next));
  EXPECT_THAT(take(), ElementsAre(a));
  EXPECT_EQ(next.get(), b);
  queue_.imported(b, std::nullopt);
}

TEST_F(WorkQueueTest, WhatIsTriedAloneIsImportedAlone) {
  const auto running = add();
  EXPECT_EQ(queue_.next_to_import(), running);
  const auto alone = add();
  alone->try_alone();
  const auto other = add();
  auto next = next_later();
  EXPECT_FALSE(goes_on(next)) << "something is imported beside it";
  queue_.imported(running, std::nullopt);
  EXPECT_EQ(next.get(), alone);
  next = next_later();
  EXPECT_FALSE(goes_on(next)) << "it is imported beside it";
  queue_.imported(alone, std::nullopt);
  EXPECT_EQ(next.get(), other);
  queue_.imported(other, std::nullopt);
}

TEST_F(WorkQueueTest, ATimingWaitsForImportsAndHoldsUpOthersAlone) {
  const auto timed = add(true), untimed = add(), running = add(), later = add();
  for (const auto& job : {timed, untimed, running}) EXPECT_EQ(queue_.next_to_import(), job);
  import(timed);
  import(untimed);
  EXPECT_THAT(take(), ElementsAre(untimed)) << "the device was held for nothing";
  EXPECT_THAT(take(), IsEmpty());
  auto next = next_later();
  EXPECT_FALSE(goes_on(next)) << "an import begins before the timing";
  import(running);
  EXPECT_THAT(take(), ElementsAre(timed));
  EXPECT_FALSE(goes_on(next)) << "an import begins beside the timing";
  queue_.measured();
  EXPECT_EQ(next.get(), later);
  EXPECT_THAT(take(), ElementsAre(running));
  queue_.imported(later, std::nullopt);
}

TEST_F(WorkQueueTest, ATimingThatNobodyWaitsForHoldsUpNothing) {
  const auto timed = add(true), running = add(), later = add();
  EXPECT_EQ(queue_.next_to_import(), timed);
  EXPECT_EQ(queue_.next_to_import(), running);
  import(timed);
  EXPECT_THAT(take(), IsEmpty());
  auto next = next_later();
  EXPECT_FALSE(goes_on(next));
  queue_.cancel(timed);
  EXPECT_EQ(next.get(), later) << "though the device's thread did not look";
  queue_.imported(running, std::nullopt);
  queue_.imported(later, std::nullopt);
}

TEST_F(WorkQueueTest, WhatIsCancelledLeavesAtOnce) {
  const auto running = add(), ready = add(), waiting = add();
  EXPECT_EQ(queue_.next_to_import(), running);
  EXPECT_EQ(queue_.next_to_import(), ready);
  import(ready, 100);
  auto next = next_later();
  EXPECT_FALSE(goes_on(next)) << "there is no room for more";
  queue_.cancel(waiting);
  EXPECT_THAT(ending(*waiting), StartsWith("cancelled: "));
  EXPECT_EQ(queue_.depth().waiting, 0U);
  const auto later = add();
  EXPECT_FALSE(goes_on(next));
  queue_.cancel(ready);
  EXPECT_THAT(ending(*ready), StartsWith("cancelled: "));
  EXPECT_EQ(queue_.depth().ready, 0U);
  EXPECT_EQ(next.get(), later) << "its memory is free again";
  Imported imported = prepare(running);
  queue_.cancel(running);
  EXPECT_FALSE(running->is_done()) << "its import has to end first";
  queue_.imported(running, std::move(imported));
  EXPECT_THAT(ending(*running), StartsWith("cancelled: "));
  EXPECT_EQ(queue_.depth().ready, 0U);
  queue_.imported(later, std::nullopt);
  queue_.cancel(later);  // it is nowhere
  queue_.add(later, true);
  EXPECT_THAT(ending(*later), StartsWith("cancelled: "));
  EXPECT_EQ(queue_.depth().waiting, 0U);
}

TEST_F(WorkQueueTest, TheLastOfWhatIsGatheredMayBeCancelled) {
  const auto running = add();  // so that more is waited for
  EXPECT_EQ(queue_.next_to_import(), running);
  for (int i = 0; i < 20; ++i) {
    const auto job = add();
    EXPECT_EQ(queue_.next_to_import(), job);
    import(job);
    auto taken = std::async(std::launch::async, [this] { return take(1); });
    std::this_thread::sleep_for(std::chrono::milliseconds(2 * i));  // at another moment each time
    queue_.cancel(job);
    EXPECT_THAT(taken.get(), testing::AnyOf(IsEmpty(), ElementsAre(job)));
    EXPECT_EQ(queue_.depth().ready, 0U);
  }
  queue_.imported(running, std::nullopt);
}

TEST_F(WorkQueueTest, TheEndRefusesWhatIsThereAndWhatComes) {
  std::vector<std::shared_ptr<Job>> jobs = {add(), add(), add()};
  queue_.next_to_import();
  queue_.next_to_import();
  import(jobs[0]);
  Imported late = prepare(jobs[1]);
  queue_.end();
  EXPECT_TRUE(queue_.has_ended());
  EXPECT_TRUE(jobs[1]->is_cancelled()) << "its import goes on";
  jobs.push_back(add());
  queue_.imported(jobs[1], std::move(late));
  EXPECT_EQ(queue_.depth().ready, 1U);
  for (const auto& job : jobs) EXPECT_EQ(ending(*job), "unavailable: the service is shutting down");
  EXPECT_EQ(queue_.next_to_import(), nullptr);
  EXPECT_THAT(take(), IsEmpty());
}

}  // namespace
}  // namespace scene_analyzer::service
