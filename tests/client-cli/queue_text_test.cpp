#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "expect_text.h"
#include "terminal/job_list_text.h"

namespace cellcrush::client {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(QueueText, ShowsTheFieldsInWhichTheJobsOfASweepDiffer) {
  v1::Queue queue;
  std::vector<v1::Job> jobs;
  for (int i = 1; i <= 2; ++i) {
    v1::Job& job = jobs.emplace_back();
    job.set_name("jobs/" + std::to_string(i));
    job.mutable_case_()->mutable_loading()->set_speed_m_per_s(50.0 * i);
    job.mutable_case_()->set_title("Type I, loading.speed_m_per_s = " + std::to_string(50 * i));
    auto& entry = *queue.add_entries();
    entry.set_job(job.name());
    entry.set_reason("All workers are busy.");
    entry.set_seconds_until_start(10.0 * i);
  }
  EXPECT_EQ(queue_text(queue, jobs, 80),
            "JOB     speed  STARTS IN  REASON\n"
            "          m/s\n"
            "Type I\n"
            "jobs/1     50       10 s  All workers are busy.\n"
            "jobs/2    100       20 s  All workers are busy.\n");
}

TEST(QueueText, NamesTheExecutorsWhereOneIsNotTheServersMachine) {
  v1::Queue queue;
  for (const char* executor : {"local", "slurm/a"}) {
    auto& entry = *queue.add_entries();
    entry.set_job("jobs/" + std::to_string(queue.entries_size()));
    entry.set_reason("It waits.");
    entry.set_executor(executor);
  }
  EXPECT_EQ(queue_text(queue, {}, 80),
            "JOB     STARTS IN  EXECUTOR  REASON\n"
            "jobs/1             local     It waits.\n"
            "jobs/2             slurm/a   It waits.\n");
  auto& hold = *queue.add_holds();
  hold.set_executor("slurm/a");
  hold.set_cause("worker");
  EXPECT_EQ(queue_text(queue, {}, 80).rfind("the queue of slurm/a has been on hold (worker) for", 0), 0U);
  queue.mutable_entries()->RemoveLast();
  EXPECT_THAT(queue_text(queue, {}, 80), Not(HasSubstr("EXECUTOR")));
}

TEST(QueueText, StandsInANarrowTerminal) {
  v1::Queue queue;
  auto& entry = *queue.add_entries();
  entry.set_job("jobs/12345");
  entry.set_reason("The job waits for its turn: its owner has 4 jobs running.");
  entry.set_seconds_until_start(3700.0);
  entry.set_priority(100);
  const std::string text = queue_text(queue, {}, 40);
  EXPECT_THAT(text, HasSubstr("\njobs/12345  The job waits for its turn:\n"));
  testing::expect_no_wider(text, 40);
}

}  // namespace
}  // namespace cellcrush::client
