#include "worker/give_up.h"

#include <gtest/gtest.h>

#include <vector>

#include "programs/temporary_folder.h"
#include "server/small_case.h"

namespace cellcrush::worker {
namespace {

// A folder in which a worker was left after some samples, and what a last one then says.
class GiveUpTest : public ::testing::Test {
 protected:
  GiveUpTest() {
    order_.set_job("jobs/1");
    *order_.mutable_case_() = testing::small_case();
    order_.set_threads(2);
    order_.set_checkpoint_interval_s(60.0);
    int asked = 0;
    EXPECT_NO_THROW(
        run_job(job_, order_, [&asked] { return ++asked > 20 ? StopRequest::suspend : StopRequest::none; }));
    samples_ = said([](const Report& report) { return report.has_sample(); });
    order_.set_threads(1);
    order_.mutable_given_up()->set_cause(v1::Job::WORKER_CRASHED);
    order_.mutable_given_up()->set_message("It was lost.");
  }

  // How many of the reports are like that.
  template <class Predicate>
  int said(const Predicate& is_meant) {
    store::ReportLogReader reader(job_.reports());
    int out = 0;
    while (reader.read(last_) == store::ReportLogReader::Read::message) out += is_meant(last_);
    return out;
  }

  testing::TemporaryFolder folder_;
  store::JobFolder job_{folder_.path()};
  Order order_;
  Report last_;  ///< of those that were read
  int samples_ = 0;
};

TEST_F(GiveUpTest, TheResultIsMadeOfWhatWasReported) {
  ASSERT_GT(samples_, 2);
  ASSERT_NO_THROW(run_job(job_, order_, [] { return StopRequest::none; }));
  EXPECT_EQ(said([](const Report& report) { return report.has_sample(); }), samples_) << "Nothing was run.";
  ASSERT_TRUE(last_.has_final());
  EXPECT_EQ(last_.final().cause(), v1::Job::WORKER_CRASHED);
  EXPECT_TRUE(last_.final().has_summary());
  EXPECT_TRUE(std::filesystem::exists(job_.result()));
}

TEST_F(GiveUpTest, ACancelIsAcknowledgedOnceAndTheResultIsMade) {
  order_.mutable_given_up()->Clear();
  order_.mutable_given_up()->set_cancelled(true);
  ASSERT_NO_THROW(run_job(job_, order_, [] { return StopRequest::cancel; }));
  EXPECT_EQ(said([](const Report& report) { return report.has_stopping(); }), 1);
  EXPECT_TRUE(last_.final().cancelled());
  EXPECT_TRUE(last_.final().has_summary());
  EXPECT_TRUE(std::filesystem::exists(job_.result()));
}

TEST_F(GiveUpTest, AskedToLeaveItLeavesTheJobAsItWas) {
  ASSERT_NO_THROW(run_job(job_, order_, [] { return StopRequest::suspend; }));
  EXPECT_EQ(said([](const Report& report) { return report.has_sample(); }), samples_);
  EXPECT_TRUE(last_.final().has_suspended_step());
  EXPECT_FALSE(last_.final().has_summary());
  EXPECT_FALSE(std::filesystem::exists(job_.result()));
  EXPECT_FALSE(std::filesystem::exists(job_.partial_result()));
}

TEST_F(GiveUpTest, WhatAnotherSolverLeftIsMadeNothingOf) {
  {
    store::ReportLog log(job_.reports());
    Report report;
    report.mutable_begun()->mutable_origin()->set_solver_revision("another");
    log.append(report);
  }
  ASSERT_NO_THROW(run_job(job_, order_, [] { return StopRequest::none; }));
  said([](const Report&) { return false; });
  EXPECT_EQ(last_.final().message(), "It was lost.");
  EXPECT_FALSE(last_.final().has_summary());
}

}  // namespace
}  // namespace cellcrush::worker
