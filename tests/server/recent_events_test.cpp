#include "watch/recent_events.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "error.h"
#include "server/sample_writer.h"
#include "server/temporary_folder.h"
#include "store/change_reader.h"
#include "store/journal.h"
#include "watch/watch_cursor.h"

namespace cellcrush::watch {
namespace {

class RecentEventsTest : public ::testing::Test {
 protected:
  void change(v1::Job::State state) {
    store::StateChange change;
    change.state = state;
    journal_.change_state(job_, change);
  }

  void add_samples(int count) {
    for (int i = 0; i < count; ++i) {
      v1::Sample sample;
      sample.set_step(step_++);
      reported_.add(journal_, job_, sample);
    }
    journal_.commit_samples();
  }

  std::vector<RecentEvents::Event> after(std::int64_t sequence, std::int64_t job) {
    return hub_.recent().after(reader_, job, sequence, hub_.open(job)->stamp());
  }

  // Numbers of all events after one.
  std::vector<std::int64_t> numbers_after(std::int64_t sequence) {
    std::vector<std::int64_t> out;
    for (auto events = after(sequence, job_); !events.empty(); events = after(out.back(), job_)) {
      for (const auto& event : events) out.push_back(event->sequence());
    }
    return out;
  }

  static std::vector<std::int64_t> range(std::int64_t first, std::int64_t last) {
    std::vector<std::int64_t> out;
    for (std::int64_t i = first; i <= last; ++i) out.push_back(i);
    return out;
  }

  testing::TemporaryFolder folder_;
  testing::SampleWriter reported_{folder_.path()};
  Hub hub_;
  store::Journal journal_{folder_.path() / "journal.sqlite", [this](std::int64_t job) { hub_.announce(job); }};
  store::JournalReader reader_{folder_.path() / "journal.sqlite"};
  std::int64_t job_ = journal_.create_job({}, "", "").job;
  std::shared_ptr<Channel> channel_ = hub_.open(job_);
  std::int64_t step_ = 0;  ///< of the next sample
};

TEST_F(RecentEventsTest, WatchersThatAreUpToDateReadTheJournalTogether) {
  change(v1::Job::RUNNING);
  std::vector<WatchCursor> cursors;
  for (int i = 0; i < 200; ++i) cursors.emplace_back(reader_, hub_, job_, 2, WatchCursor::Wanted{});
  for (auto& cursor : cursors) EXPECT_TRUE(cursor.next()->has_snapshot());
  for (int round = 0; round < 3; ++round) {
    add_samples(10);
    const auto before = hub_.recent().reads();
    for (auto& cursor : cursors) {
      for (int i = 0; i < 10; ++i) EXPECT_EQ(cursor.next()->sequence(), 3 + round * 10 + i);
      EXPECT_FALSE(cursor.next());
      EXPECT_FALSE(cursor.next());
    }
    EXPECT_LE(hub_.recent().reads() - before, 2) << "One finds the samples, one that nothing follows.";
  }
}

TEST_F(RecentEventsTest, AWatcherThatLagsOrBeginsLateGetsEveryEventOnce) {
  change(v1::Job::RUNNING);
  for (int round = 0; round < 5; ++round) {
    const std::int64_t end = 2 + 200 * round;
    add_samples(200);
    EXPECT_EQ(numbers_after(end), range(end + 1, end + 200)) << "of a watcher that is up to date";
  }
  EXPECT_EQ(numbers_after(0), range(1, 1002));
  EXPECT_EQ(numbers_after(700), range(701, 1002));
  EXPECT_EQ(numbers_after(1002), range(1, 0));
}

TEST_F(RecentEventsTest, ALateWatcherGetsNoSampleFromBeforeTheJobBeganAgain) {
  change(v1::Job::RUNNING);
  add_samples(10);
  EXPECT_EQ(numbers_after(0), range(1, 12));
  journal_.begin_again(job_, "Restarted.");
  reported_.discard(job_);
  EXPECT_EQ(numbers_after(0), (std::vector<std::int64_t>{1, 2, 13}));
}

TEST_F(RecentEventsTest, EveryWatcherLearnsThatTheJobWasDeleted) {
  change(v1::Job::CANCELLED);
  EXPECT_EQ(numbers_after(0), range(1, 2));
  journal_.delete_job(job_);
  for (int i = 0; i < 3; ++i) {
    try {
      after(2, job_);
      FAIL() << "The job is still found.";
    } catch (const ServiceError& error) {
      EXPECT_EQ(error.kind(), ServiceError::Kind::not_found);
    }
  }
}

TEST_F(RecentEventsTest, OnlySomeJobsAreKept) {
  EXPECT_EQ(after(0, job_).size(), 1U);
  EXPECT_EQ(after(0, job_).size(), 1U) << "finds that nothing follows";
  const auto before = hub_.recent().reads();
  EXPECT_EQ(after(0, job_).size(), 1U);
  EXPECT_EQ(hub_.recent().reads(), before);
  for (std::size_t i = 0; i < RecentEvents::kMostJobs; ++i)
    EXPECT_EQ(after(0, journal_.create_job({}, "", "").job).size(), 1U);
  const auto then = hub_.recent().reads();
  EXPECT_EQ(after(0, job_).size(), 1U);
  EXPECT_EQ(hub_.recent().reads(), then + 1) << "The job used least recently was dropped.";
}

TEST_F(RecentEventsTest, WatchersOnSeveralThreadsGetEveryEventOnceWhileTheJobRuns) {
  constexpr int kSamples = 3000;
  change(v1::Job::RUNNING);
  std::atomic<int> right = 0;
  {
    std::vector<std::jthread> watchers;
    for (int i = 0; i < 6; ++i) {
      watchers.emplace_back([&, i] {
        WatchCursor cursor(reader_, hub_, job_, i % 2, {});
        std::int64_t last = i % 2;
        bool in_order = true;
        while (!cursor.ended()) {
          const auto event = cursor.next();
          if (event && (event->has_state() || event->has_sample())) in_order &= event->sequence() == ++last;
          if (!event && i < 3) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        right += in_order && last == kSamples + 3;
      });
    }
    for (int i = 0; i < kSamples / 30; ++i) add_samples(30);
    change(v1::Job::SUCCEEDED);
  }
  EXPECT_EQ(right, 6);
}

TEST_F(RecentEventsTest, ChangesAreLookedForOncePerStamp) {
  store::ChangeReader changes(folder_.path() / "journal.sqlite");
  const auto last = changes.last();
  EXPECT_FALSE(changes.has_after(last, {1, 0}));
  change(v1::Job::RUNNING);
  EXPECT_FALSE(changes.has_after(last, {1, 0})) << "Nobody has announced it.";
  EXPECT_TRUE(changes.has_after(last, {2, 0}));
  EXPECT_FALSE(changes.has_after(last + 1, {2, 0}));
  change(v1::Job::CANCELLING);
  EXPECT_TRUE(changes.has_after(last + 1, {2, 1})) << "Time has passed.";
}

}  // namespace
}  // namespace cellcrush::watch
