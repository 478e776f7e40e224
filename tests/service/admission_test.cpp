// How many requests are taken, and what those are told that are not.
#include "service/admission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <list>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "service/refused.h"

namespace scene_analyzer::service {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// A ticket that can be given back before the end of a block.
std::unique_ptr<Admission::Ticket> enter(Admission& admission) {
  return std::unique_ptr<Admission::Ticket>(new Admission::Ticket(admission.admit()));
}

// What one more is told about when a place is likely to be free.
std::optional<milliseconds> hint(Admission& admission) {
  try {
    admission.admit();
  } catch (const Refusal& refusal) {
    return refusal.retry_after();
  }
  return std::nullopt;
}

TEST(Admission, TakesAsManyAsItIsTold) {
  Admission admission(3);
  std::list<std::unique_ptr<Admission::Ticket>> tickets;
  for (std::size_t i = 1; i <= 3; ++i) {
    tickets.push_back(enter(admission));
    EXPECT_EQ(admission.admitted(), i);
  }
  for (int again = 0; again < 2; ++again)
    EXPECT_THAT(refused([&] { admission.admit(); }),
                AllOf(StartsWith("busy: 3 requests"), HasSubstr("--queue"), HasSubstr("try again in")));
  EXPECT_EQ(admission.admitted(), 3U) << "who is refused takes no place";
}

TEST(Admission, APlaceThatIsLeftIsFree) {
  Admission admission(1);
  auto ticket = enter(admission);
  EXPECT_THAT(refused([&] { admission.admit(); }), StartsWith("busy: "));
  ticket.reset();
  EXPECT_EQ(admission.admitted(), 0U);
  EXPECT_EQ(refused([&] { admission.admit(); }), "");
  EXPECT_EQ(refused([&] { admission.admit(); }), "") << "the ticket before was destroyed at once";
}

TEST(Admission, TheHintLiesWithinItsBounds) {
  Admission one(1);
  const auto ticket = enter(one);
  ASSERT_TRUE(hint(one));
  EXPECT_GE(*hint(one), milliseconds(100));
  EXPECT_LE(*hint(one), milliseconds(30'000));

  constexpr std::size_t kMany = 1000;  // of which one leaves within a millisecond
  Admission many(kMany);
  std::list<std::unique_ptr<Admission::Ticket>> tickets;
  for (std::size_t i = 0; i < kMany; ++i) tickets.push_back(enter(many));
  EXPECT_EQ(hint(many), milliseconds(100));
}

TEST(Admission, TheHintFollowsHowLongRequestsTake) {
  Admission admission(1);
  auto ticket = enter(admission);
  const auto before = hint(admission);
  ASSERT_TRUE(before);
  ticket.reset();
  for (int i = 0; i < 200; ++i) enter(admission);  // that end at once
  ticket = enter(admission);
  ASSERT_TRUE(hint(admission));
  EXPECT_LT(*hint(admission), *before);
}

TEST(Admission, ClosedItTakesNobodyAndKeepsWhoIsThere) {
  Admission admission(2);
  auto ticket = enter(admission);
  admission.close();
  EXPECT_THAT(refused([&] { admission.admit(); }), StartsWith("unavailable: the service is shutting down"));
  EXPECT_EQ(hint(admission), std::nullopt) << "it does not come back";
  EXPECT_EQ(admission.admitted(), 1U);
  ticket.reset();
  EXPECT_THAT(refused([&] { admission.admit(); }), StartsWith("unavailable: "));
}

TEST(Admission, WaitsUntilAllHaveLeft) {
  Admission admission(4);
  EXPECT_TRUE(admission.wait_until_empty(steady_clock::now())) << "nobody is there";
  auto first = enter(admission), second = enter(admission);
  EXPECT_FALSE(admission.wait_until_empty(steady_clock::now()));
  EXPECT_FALSE(admission.wait_until_empty(steady_clock::now() + milliseconds(1)));
  first.reset();
  EXPECT_FALSE(admission.wait_until_empty(steady_clock::now() + milliseconds(1))) << "one is left";
  std::atomic<bool> empty = false;
  std::jthread waiter(
      [&] { empty = admission.wait_until_empty(steady_clock::now() + std::chrono::minutes(5)); });
  EXPECT_FALSE(empty);
  second.reset();
  waiter.join();
  EXPECT_TRUE(empty);
}

TEST(Admission, ManyThreadsAreNeverMoreThanItTakes) {
  constexpr std::size_t kMost = 3;
  Admission admission(kMost);
  std::atomic<std::size_t> inside = 0, most = 0, admitted = 0, refusals = 0;
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 8; ++thread)
      threads.emplace_back([&] {
        for (int i = 0; i < 500; ++i) try {
            const Admission::Ticket ticket = admission.admit();
            const std::size_t now = ++inside;
            for (std::size_t seen = most; seen < now && !most.compare_exchange_weak(seen, now);) continue;
            std::this_thread::yield();
            --inside;
            ++admitted;
          } catch (const Refusal&) {
            ++refusals;
          }
      });
  }
  EXPECT_LE(most, kMost);
  EXPECT_GT(admitted, 0U);
  EXPECT_EQ(admitted + refusals, 8U * 500U);
  EXPECT_EQ(admission.admitted(), 0U);
}

}  // namespace
}  // namespace scene_analyzer::service
