#include "watch/sweep_source.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include "error.h"
#include "server/watch_fixture.h"

namespace cellcrush::watch {
namespace {

class SweepSourceTest : public WatchFixture {
 protected:
  Received<SweepSource, v1::WatchSweepResponse> source(const std::string& token = "") {
    return {reader_, sweeps_, hub_, made_.sweep, token};
  }

  void run(std::int64_t job, int samples) {
    change(job, v1::Job::RUNNING);
    add_samples(job, samples);
    change(job, v1::Job::SUCCEEDED);
  }

  // Each job's numbered events must count on from what is in `seen`.
  static void note(const v1::WatchSweepResponse& response, std::map<std::string, std::int64_t>& seen) {
    const auto& event = response.event();
    if (event.has_state() || event.has_sample()) {
      EXPECT_EQ(event.sequence(), ++seen[response.job()]) << response.job();
    }
  }

  store::SweepReader sweeps_{folder_.path() / "journal.sqlite"};
  store::Journal::CreatedSweep made_ = journal_.create_sweep({}, std::vector<store::SweepJob>(3), "", "");
};

TEST_F(SweepSourceTest, EveryTokenContinuesWithoutLossAndWithoutRepetition) {
  for (const std::int64_t job : made_.jobs) run(job, 5);
  auto whole = source();
  std::vector<v1::WatchSweepResponse> all;
  while (auto response = whole.next()) all.push_back(*std::move(response));
  std::map<std::string, std::int64_t> seen;
  for (const auto& response : all) {
    note(response, seen);
    if (response.resume_token().empty()) continue;
    auto rest = seen;
    auto continued = source(response.resume_token());
    while (const auto next = continued.next()) note(*next, rest);
    for (const std::int64_t job : made_.jobs) EXPECT_EQ(rest["jobs/" + std::to_string(job)], 8);
    EXPECT_TRUE(continued.ended());
  }
}

TEST_F(SweepSourceTest, WhatIsSaidToBeAtHandIsOfTheSameJobAlsoWhenItsTurnEnds) {
  for (const std::int64_t job : made_.jobs) run(job, 600);
  auto source = this->source();
  std::string job;
  int at_hand = 0;
  for (bool has_more = false; const auto response = source.next(); has_more = source.has_more()) {
    if (has_more) {
      ++at_hand;
      ASSERT_EQ(response->job(), job);
    }
    job = response->job();
  }
  EXPECT_GT(at_hand, 1500);
}

TEST_F(SweepSourceTest, NewsOfAJobWakeTheWatcherAndOnlyThatJobSpeaks) {
  auto source = this->source();
  int woken = 0;
  source.open([&woken] { ++woken; });
  while (source.next()) {
  }
  EXPECT_FALSE(source.ended());
  woken = 0;
  change(made_.jobs[1], v1::Job::RUNNING);
  EXPECT_GT(woken, 0);
  const auto response = source.next();
  ASSERT_TRUE(response);
  EXPECT_EQ(response->job(), "jobs/" + std::to_string(made_.jobs[1]));
  EXPECT_FALSE(source.next());
  const auto bookmark = source.bookmark().parsed<v1::WatchSweepResponse>();
  EXPECT_TRUE(bookmark.event().has_bookmark());
  EXPECT_FALSE(bookmark.resume_token().empty());
  source.close();
  woken = 0;
  change(made_.jobs[1], v1::Job::SUCCEEDED);
  EXPECT_EQ(woken, 0);
}

TEST_F(SweepSourceTest, AJobThatIsDeletedMeanwhileIsLeftOut) {
  auto source = this->source();
  while (source.next()) {
  }
  journal_.cancel_waiting(made_.jobs);
  journal_.delete_job(made_.jobs[0]);
  source.open([] {});
  auto late = this->source();
  while (late.next()) {
  }
  EXPECT_TRUE(late.ended());
  source.close();
}

// Every second job of 2000 ends: a token of its own for each would send 24 MB.
TEST_F(SweepSourceTest, LongTokensAtMostDoubleWhatIsSentAndLoseNothing) {
  made_ = journal_.create_sweep({}, std::vector<store::SweepJob>(4000), "", "");
  auto source = this->source();
  while (source.next()) {
  }
  std::vector<std::int64_t> cancelled;
  for (std::size_t i = 0; i < made_.jobs.size(); i += 2) cancelled.push_back(made_.jobs[i]);
  source.open([] {});
  journal_.cancel_waiting(cancelled);
  std::size_t events = 0;
  std::size_t event_bytes = 0;
  std::size_t token_bytes = 0;
  std::size_t since_token = 0;
  std::string token;
  while (const auto response = source.next()) {
    ++events;
    event_bytes += response->event().ByteSizeLong();
    token_bytes += response->resume_token().size();
    since_token = response->resume_token().empty() ? since_token + 1 : 0;
    if (!response->resume_token().empty()) token = response->resume_token();
  }
  source.close();
  EXPECT_EQ(events, cancelled.size());
  EXPECT_LT(token_bytes, 2 * event_bytes);
  auto rest = this->source(token);
  std::size_t repeated = 0;
  while (const auto response = rest.next()) repeated += response->event().has_state();
  EXPECT_EQ(repeated, since_token) << "what came after the last token, and no more";
}

TEST_F(SweepSourceTest, AnotherSweepsTokenAndNonsenseAreRefused) {
  for (const char* token : {"x", "2:1+3=0;", "1", "1:1+3", "1:1+-3=0;", "1:1+99999999999=0;", "1:1+3=x;"})
    EXPECT_THROW(source(token), ServiceError) << token;
}

TEST(ResumeToken, ManyJobsInTheSamePlaceAreShort) {
  std::vector<JobPlace> places;
  for (std::int64_t i = 1; i <= 10'000; ++i) places.push_back({i, i <= 5000 ? 7 * i : 1, i <= 5000});
  JobPlaces all(places);
  all.set_sequence(5000, 33);
  const auto token = all.token(4);
  EXPECT_LT(token.size(), 60U);
  const auto read = parse_resume_token(4, token);
  ASSERT_EQ(read.size(), 10'000U);
  EXPECT_TRUE(read.at(5000).ended);
  EXPECT_EQ(read.at(5001).sequence, 33);
  EXPECT_EQ(read.at(10'000).sequence, 1);
}

// The reference is a list built from scratch, whose runs are found by comparing
// all neighbours.
TEST(ResumeToken, IsTheSameWhetherThePlacesChangedOneByOneOrAtOnce) {
  std::vector<JobPlace> places;
  for (std::int64_t i = 0; i < 50; ++i) places.push_back({i < 20 ? i : i + 3, 0, false});
  JobPlaces changed(places);
  std::uint32_t random = 1;
  for (int i = 0; i < 2000; ++i) {
    random = random * 1664525U + 1013904223U;
    const std::size_t index = (random >> 8U) % places.size();
    if (i > 1500) {
      places[index].ended = true;
      changed.set_ended(index);
    } else {
      places[index].sequence = (random >> 20U) % 3;
      changed.set_sequence(index, places[index].sequence);
    }
    ASSERT_EQ(changed.token(7), JobPlaces(places).token(7)) << i;
  }
  for (std::size_t i = 0; i < places.size(); ++i) changed.set_ended(i);
  EXPECT_EQ(changed.token(7), "7:0+20=e;23+30=e;");
}

TEST(ResumeToken, JobsThatAreNamedAgainAreRefusedAtOnce) {
  // Each of the runs stays under the limit of their number; to go through them all would exceed the test's time.
  std::string token = "4:";
  while (token.size() < 1'000'000) token += "1+50000=e;";
  EXPECT_THROW(parse_resume_token(4, token), ServiceError);
  EXPECT_THROW(parse_resume_token(4, "4:5+1=e;4+1=e;"), ServiceError);
}

}  // namespace
}  // namespace cellcrush::watch
