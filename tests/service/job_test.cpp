// What those see who have ordered a job.
#include "service/job.h"

#include <gtest/gtest.h>

#include <thread>

namespace scene_analyzer::service {
namespace {

using std::chrono::steady_clock;

Order some_order() {
  return {.asset = "a.obj", .files = nullptr, .options = {}, .picture = std::nullopt};
}

Job::State now(const Job& job) {
  return job.wait(UINT64_MAX, steady_clock::now());
}

TEST(Job, BeginsAsWaiting) {
  const Job job(some_order());
  EXPECT_EQ(now(job).fraction, 0);
  EXPECT_EQ(now(job).step, "waiting");
  EXPECT_FALSE(now(job).done);
  EXPECT_FALSE(job.is_cancelled());
}

TEST(Job, EveryChangeHasTheNextVersionAndFractionsNeverFall) {
  Job job(some_order());
  const std::uint64_t first = now(job).version;
  job.report(0.5, "half");
  EXPECT_EQ(job.wait(first, steady_clock::now()).version, first + 1);
  job.report(0.25, "again");
  EXPECT_EQ(now(job).fraction, 0.5);
  EXPECT_EQ(now(job).step, "again");
  job.finish({});
  EXPECT_TRUE(now(job).done);
  EXPECT_EQ(now(job).fraction, 1);
  job.report(0.75, "too late");
  EXPECT_EQ(now(job).step, "again");
  EXPECT_EQ(now(job).version, first + 3);
}

TEST(Job, WhoWaitsIsWoken) {
  Job job(some_order());
  const std::uint64_t seen = now(job).version;
  Job::State state;
  std::jthread waiter([&] { state = job.wait(seen, steady_clock::now() + std::chrono::minutes(5)); });
  job.report(0.5, "half");
  waiter.join();
  EXPECT_EQ(state.version, seen + 1);
}

TEST(Job, TheFirstAnswerCounts) {
  Job job(some_order());
  job.refuse(Reason::kInvalid, "wrong");
  Answer good;
  good.analysis.emplace();
  job.finish(std::move(good));
  job.refuse(Reason::kInternal, "later");
  EXPECT_TRUE(job.is_done());
  EXPECT_LT(now(job).fraction, 1);
  const Answer answer = job.take_answer();
  ASSERT_TRUE(answer.refusal);
  EXPECT_EQ(answer.refusal->reason(), Reason::kInvalid);
  EXPECT_STREQ(answer.refusal->what(), "wrong");
  EXPECT_FALSE(answer.analysis);
}

TEST(Job, CancellingStopsTheImportAndLeavesTheOrderAsItWas) {
  Order ordered = some_order();
  std::stop_source others;
  ordered.options.import_limits.stop = others.get_token();
  Job job(std::move(ordered));
  others.request_stop();
  EXPECT_FALSE(job.options()->import_limits.stop.stop_requested());
  EXPECT_FALSE(job.is_given_up());
  job.cancel();
  EXPECT_TRUE(job.is_cancelled());
  EXPECT_TRUE(job.is_given_up());
  EXPECT_TRUE(job.options()->import_limits.stop.stop_requested());
  EXPECT_FALSE(job.is_done()) << "the executor says when";
}

TEST(Job, MeasuredWithOthersItIsGivenUpWithAll) {
  Job job(some_order());
  bool all = false;
  job.share_fate([&] { return all; });
  job.cancel();
  EXPECT_FALSE(job.is_given_up());
  all = true;
  EXPECT_TRUE(job.is_given_up());
  job.share_fate({});
  EXPECT_TRUE(job.is_given_up());
}

TEST(Job, IsTriedAloneOnce) {
  Job job(some_order());
  EXPECT_FALSE(job.is_alone());
  EXPECT_TRUE(job.try_alone());
  EXPECT_TRUE(job.is_alone());
  EXPECT_FALSE(job.try_alone());
}

}  // namespace
}  // namespace scene_analyzer::service
