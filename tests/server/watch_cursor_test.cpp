#include "watch/watch_cursor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "error.h"
#include "server/refuses.h"
#include "server/watch_fixture.h"
#include "watch/sent_frame.h"

namespace cellcrush::watch {
namespace {

using Cursor = Received<WatchCursor, v1::JobEvent>;

class WatchCursorTest : public WatchFixture {
 protected:
  Cursor cursor(std::int64_t after = 0, bool frames = true) {
    return {reader_, hub_, job_, after, WatchCursor::Wanted{frames, true, v1::FieldFrame::NUMBERS}};
  }

  void change(v1::Job::State state) { WatchFixture::change(job_, state); }
  void add_samples(int count) { WatchFixture::add_samples(job_, count); }

  static v1::FieldFrame frame(int index) {
    v1::FieldFrame out;
    out.set_index(index);
    out.add_position_mm(1.0F);
    return out;
  }

  std::int64_t job_ = journal_.create_job({}, "", "").job;
};

TEST_F(WatchCursorTest, WhatIsAtHandIsGivenWithoutAnotherLookIntoTheJournal) {
  change(v1::Job::RUNNING);
  add_samples(3);
  change(v1::Job::SUCCEEDED);
  auto cursor = this->cursor();
  EXPECT_FALSE(cursor.has_more());
  for (int given = 0; given < 7; ++given) {
    ASSERT_TRUE(cursor.next());
    EXPECT_EQ(cursor.has_more(), given > 0 && given < 6) << "The first is the snapshot, the second reads the rest.";
  }
}

TEST_F(WatchCursorTest, ThePartsOfAFrameAreGivenWithoutALookIntoTheJournal) {
  const auto channel = hub_.open(job_);
  auto cursor = this->cursor();
  cursor.next();
  EXPECT_TRUE(cursor.next()->has_state());
  auto large = frame(0);
  for (std::size_t i = 0; i < 2 * kChunkBytes / sizeof(float); ++i) large.add_position_mm(1.0F);
  channel->publish(std::move(large));
  ASSERT_TRUE(cursor.next()->has_frame());
  ASSERT_TRUE(cursor.has_more());
  // What only a look into the journal can tell.
  change(v1::Job::RUNNING);
  while (cursor.has_more()) ASSERT_TRUE(cursor.next()->has_frame());
  EXPECT_TRUE(cursor.next()->has_state());
}

TEST_F(WatchCursorTest, AMeshThatIsBuiltDuringTheWatchPrecedesTheSamplesAndComesAgainAfterARestart) {
  const auto channel = hub_.open(job_);
  auto cursor = this->cursor();
  EXPECT_TRUE(cursor.next()->has_snapshot());
  EXPECT_TRUE(cursor.next()->has_state());
  EXPECT_FALSE(cursor.next());
  change(v1::Job::RUNNING);
  EXPECT_TRUE(cursor.next()->has_state());
  v1::Mesh mesh;
  mesh.set_particle_count(7);
  journal_.set_mesh(job_, mesh);
  channel->publish(mesh);
  add_samples(2);
  journal_.commit_samples();
  const auto first = cursor.next();
  ASSERT_TRUE(first->has_mesh());
  EXPECT_EQ(first->mesh().mesh().particle_count(), 7);
  EXPECT_EQ(first->sequence(), 2);
  EXPECT_TRUE(cursor.next()->has_sample());
  EXPECT_TRUE(cursor.next()->has_sample());
  journal_.begin_again(job_, "Restarted.");
  EXPECT_EQ(reader_.find_job(job_)->job.attempt(), 1);
  EXPECT_EQ(reader_.find_job(job_)->job.begun_again_sequence(), 5);
  EXPECT_EQ(reader_.find_job(job_)->samples, 0);
  EXPECT_FALSE(reader_.mesh(job_));
  reported_.discard(job_);
  channel->forget();
  EXPECT_TRUE(cursor.next()->has_state());
  EXPECT_FALSE(cursor.next());
  channel->publish(mesh);
  EXPECT_TRUE(cursor.next()->has_mesh());
  EXPECT_FALSE(cursor.next());
  auto late = this->cursor();
  std::vector<std::int64_t> numbers;
  while (const auto event = late.next()) {
    if (event->has_state() || event->has_sample()) numbers.push_back(event->sequence());
  }
  EXPECT_EQ(numbers, (std::vector<std::int64_t>{1, 2, 5})) << "The samples do not count any more.";
}

TEST_F(WatchCursorTest, AFrameWakesOnlyThoseWhoWantFrames) {
  const auto channel = hub_.open(job_);
  EXPECT_FALSE(channel->is_watched());
  int plain = 0;
  int framed = 0;
  const auto first = channel->subscribe([&plain] { ++plain; }, false);
  const auto second = channel->subscribe([&framed] { ++framed; }, true);
  EXPECT_TRUE(channel->is_watched());
  channel->publish(frame(0));
  EXPECT_EQ(plain, 0);
  EXPECT_EQ(framed, 1);
  channel->publish(v1::Progress());
  hub_.announce(job_);
  EXPECT_EQ(plain, 2);
  EXPECT_EQ(framed, 3);
  channel->unsubscribe(first);
  channel->unsubscribe(second);
  EXPECT_FALSE(channel->is_watched());
}

TEST_F(WatchCursorTest, TheNewestFrameWinsAndTheGapIsTold) {
  const auto channel = hub_.open(job_);
  auto cursor = this->cursor();
  cursor.next();
  EXPECT_EQ(cursor.next()->state().state(), v1::Job::PENDING);
  channel->publish(frame(0));
  EXPECT_EQ(cursor.next()->frame().frame().index(), 0);
  for (int i = 1; i <= 4; ++i) channel->publish(frame(i));
  const auto newest = cursor.next();
  EXPECT_EQ(newest->frame().frame().index(), 4);
  EXPECT_EQ(newest->frame().skipped(), 3);
  EXPECT_FALSE(cursor.next());
}

TEST_F(WatchCursorTest, WhatAllAreSentIsEncodedOnce) {
  const auto channel = hub_.open(job_);
  WatchCursor one(reader_, hub_, job_, 0, {true, true, v1::FieldFrame::PACKED});
  WatchCursor other(reader_, hub_, job_, 1, {true, true, v1::FieldFrame::PACKED});
  v1::Mesh mesh;
  mesh.set_particle_count(1);
  channel->publish(mesh);
  one.next();
  other.next();
  EXPECT_EQ(one.next()->shared, other.next()->shared) << "a part of the mesh";
  EXPECT_TRUE(one.next()->is_numbered);
  channel->publish(frame(0));
  const auto first = one.next();
  EXPECT_EQ(first->shared, other.next()->shared) << "a part of the frame";
  change(v1::Job::RUNNING);
  const auto state = one.next();
  EXPECT_EQ(state->shared, other.next()->shared);
  EXPECT_EQ(state->size(), state->shared->size());
}

TEST_F(WatchCursorTest, OneThatHasAllIsQuietUntilSomethingChanges) {
  const auto channel = hub_.open(job_);
  auto cursor = this->cursor();
  const auto read_all = [&cursor] {
    while (cursor.next()) EXPECT_FALSE(cursor.has_more() && cursor.is_quiet());
  };
  EXPECT_FALSE(cursor.is_quiet());
  read_all();
  EXPECT_TRUE(cursor.is_quiet());
  channel->publish(v1::Progress());
  EXPECT_FALSE(cursor.is_quiet());
  read_all();
  channel->publish(frame(0));
  EXPECT_FALSE(cursor.is_quiet());
  read_all();
  change(v1::Job::RUNNING);
  EXPECT_FALSE(cursor.is_quiet());
  read_all();
  EXPECT_TRUE(cursor.is_quiet());
}

TEST_F(WatchCursorTest, FramesAreSentOnlyToThoseWhoAsk) {
  hub_.open(job_)->publish(frame(0));
  auto cursor = this->cursor(1, false);
  EXPECT_TRUE(cursor.next()->has_snapshot());
  EXPECT_FALSE(cursor.next());
}

TEST_F(WatchCursorTest, AJobThatIsDeletedMeanwhileIsNotFound) {
  change(v1::Job::RUNNING);
  add_samples(600);
  change(v1::Job::CANCELLING);
  change(v1::Job::CANCELLED);
  auto cursor = this->cursor();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(cursor.next());
  journal_.delete_job(job_);
  EXPECT_THAT(
      [&] {
        while (cursor.next()) continue;
      },
      testing::Refuses(ServiceError::Kind::not_found, ""));
  EXPECT_FALSE(cursor.ended());
}

TEST_F(WatchCursorTest, WatchersThatAreUpToDateReadTheJournalTogether) {
  change(v1::Job::RUNNING);
  std::vector<Cursor> cursors;
  for (int i = 0; i < 200; ++i) cursors.emplace_back(reader_, hub_, job_, 2, WatchCursor::Wanted{});
  for (auto& cursor : cursors) EXPECT_TRUE(cursor.next()->has_snapshot());
  for (int round = 0; round < 3; ++round) {
    add_samples(10);
    journal_.commit_samples();
    const auto before = hub_.recent().reads();
    for (auto& cursor : cursors) {
      for (int i = 0; i < 10; ++i) EXPECT_EQ(cursor.next()->sequence(), 3 + round * 10 + i);
      EXPECT_FALSE(cursor.next());
      EXPECT_FALSE(cursor.next());
    }
    EXPECT_LE(hub_.recent().reads() - before, 2) << "One finds the samples, one that nothing follows.";
  }
}

TEST_F(WatchCursorTest, WatchersOnSeveralThreadsGetEveryEventOnceWhileTheJobRuns) {
  constexpr int kSamples = 3000;
  change(v1::Job::RUNNING);
  std::atomic<int> right = 0;
  {
    std::vector<std::jthread> watchers;
    for (int i = 0; i < 6; ++i) {
      watchers.emplace_back([&, i] {
        Cursor cursor(reader_, hub_, job_, i % 2, WatchCursor::Wanted{});
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
    for (int i = 0; i < kSamples / 30; ++i) {
      add_samples(30);
      journal_.commit_samples();
    }
    change(v1::Job::SUCCEEDED);
  }
  EXPECT_EQ(right, 6);
}

TEST_F(WatchCursorTest, OnlySomeJobsAreKept) {
  const auto look = [this](std::int64_t job) {
    return hub_.recent().after(reader_, job, 0, hub_.open(job)->stamp()).size();
  };
  const auto channel = hub_.open(job_);
  EXPECT_EQ(look(job_), 1U);
  EXPECT_EQ(look(job_), 1U);
  EXPECT_EQ(hub_.recent().reads(), 1);
  for (std::size_t i = 0; i < RecentEvents::kMostJobs; ++i) EXPECT_EQ(look(journal_.create_job({}, "", "").job), 1U);
  const auto then = hub_.recent().reads();
  EXPECT_EQ(look(job_), 1U);
  EXPECT_EQ(hub_.recent().reads(), then + 1) << "The job used least recently was dropped.";
}

}  // namespace
}  // namespace cellcrush::watch
