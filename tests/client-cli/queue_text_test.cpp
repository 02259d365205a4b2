#include <gmock/gmock.h>
#include <google/protobuf/util/time_util.h>
#include <gtest/gtest.h>

#include "expect_text.h"
#include "programs/text_proto.h"
#include "terminal/job_list_text.h"

namespace cellcrush::client {
namespace {

using cellcrush::testing::from_text;
using cellcrush::testing::with_text;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(QueueText, ShowsTheFieldsInWhichTheJobsOfASweepDiffer) {
  const auto queue = from_text<v1::Queue>(R"(
    entries { job: "jobs/1" reason: "All workers are busy." seconds_until_start: 10 }
    entries { job: "jobs/2" reason: "All workers are busy." seconds_until_start: 20 })");
  const std::vector<v1::Job> jobs = {from_text<v1::Job>(R"(name: "jobs/1" case {
        loading { speed_m_per_s: 50 } title: "Type I, loading.speed_m_per_s = 50" })"),
                                     from_text<v1::Job>(R"(name: "jobs/2" case {
        loading { speed_m_per_s: 100 } title: "Type I, loading.speed_m_per_s = 100" })")};
  EXPECT_EQ(queue_text(queue, jobs, 80),
            "JOB     speed  STARTS IN  REASON\n"
            "          m/s\n"
            "Type I\n"
            "jobs/1     50       10 s  All workers are busy.\n"
            "jobs/2    100       20 s  All workers are busy.\n");
}

TEST(QueueText, NamesTheExecutorsWhereOneIsNotTheServersMachine) {
  auto queue = from_text<v1::Queue>(R"(entries { job: "jobs/1" reason: "It waits." executor: "local" }
                                       entries { job: "jobs/2" reason: "It waits." executor: "slurm/a" })");
  EXPECT_EQ(queue_text(queue, {}, 80),
            "JOB     STARTS IN  EXECUTOR  REASON\n"
            "jobs/1             local     It waits.\n"
            "jobs/2             slurm/a   It waits.\n");
  queue = with_text(queue, R"(holds { executor: "slurm/a" cause: "worker" })");
  EXPECT_EQ(queue_text(queue, {}, 80).rfind("the queue of slurm/a has been on hold (worker) for", 0), 0U);
  queue.mutable_entries()->RemoveLast();
  EXPECT_THAT(queue_text(queue, {}, 80), Not(HasSubstr("EXECUTOR")));
}

TEST(QueueText, StandsInANarrowTerminal) {
  const auto queue = from_text<v1::Queue>(R"(entries { job: "jobs/12345" seconds_until_start: 3700 priority: 100
    reason: "The job waits for its turn: its owner has 4 jobs running." })");
  const std::string text = queue_text(queue, {}, 40);
  EXPECT_THAT(text, HasSubstr("\njobs/12345  The job waits for its turn:\n"));
  testing::expect_no_wider(text, 40);
}

TEST(StatusText, HasTheVersionTheDiskTheExecutorsAndWhatHoldsTheQueue) {
  v1::Capabilities server;
  server.set_version("0.1.0+abc");
  *server.mutable_start_time() =
      google::protobuf::util::TimeUtil::GetCurrentTime() - google::protobuf::util::TimeUtil::HoursToDuration(3);
  server.set_free_disk_bytes(50'000'000'000);
  server.set_kept_disk_bytes(256'000'000);
  server.set_waiting_count(12);
  auto& local = *server.add_executors();
  local.set_name("local");
  local.set_job_limit(2);
  local.set_running_count(1);
  v1::Queue queue;
  queue.set_cores("2 cores");
  EXPECT_EQ(status_text(server, queue, 80),
            "version        0.1.0+abc\n"
            "runs for       3 h 00 min\n"
            "uses           2 cores\n"
            "free disk      50.0 GB; jobs wait below 256 MB\n"
            "runs on local  1 job of 2 at once\n"
            "waiting jobs   12\n");
  auto& hold = *queue.add_holds();
  hold.set_cause("low_disk");
  hold.set_reason("The disk is nearly full.");
  hold.set_remedy("Delete jobs.");
  server.set_draining(true);
  const std::string text = status_text(server, queue, 80);
  EXPECT_THAT(text, HasSubstr("accepts jobs   no"));
  EXPECT_THAT(text, HasSubstr("low_disk"));
  EXPECT_THAT(text, HasSubstr("Delete jobs."));
}

}  // namespace
}  // namespace cellcrush::client
