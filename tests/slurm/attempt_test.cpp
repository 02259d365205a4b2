// One attempt, seen from its task and from the daemon, without Slurm.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <future>

#include "programs/temporary_folder.h"
#include "server/brick_network.h"
#include "server/small_case.h"
#include "slurm/attempt_exit.h"
#include "slurm/attempt_folder.h"
#include "slurm/attempt_run.h"
#include "slurm/executor_run.h"
#include "slurm/slurm_executor.h"
#include "slurm/small_file.h"
#include "slurm/task.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Kind = jobs::WorkerExit::Kind;
using std::chrono::milliseconds;
namespace fs = std::filesystem;

slurm::Ended left(slurm::Ended::Reason reason) {
  slurm::Ended out;
  out.set_kind(slurm::Ended::LEFT);
  out.set_reason(reason);
  return out;
}

// The warning came while the worker wrote its result.
TEST(AttemptExit, AResultCountsWhateverTheTaskWasTold) {
  for (const auto reason : {slurm::Ended::TIME_LIMIT, slurm::Ended::TERMINATED, slurm::Ended::LEASE}) {
    auto ended = left(reason);
    ended.mutable_final()->mutable_summary();
    const auto exit = slurm::exit_of_last_word(ended, {}, "n1");
    EXPECT_TRUE(exit.final && exit.final->has_summary());
    EXPECT_TRUE(slurm::ends_job(ended));
  }
  auto ended = left(slurm::Ended::TIME_LIMIT);
  ended.mutable_final()->set_suspended_step(7);
  EXPECT_EQ(slurm::exit_of_last_word(ended, {}, "n1").kind, Kind::gone);
  EXPECT_FALSE(slurm::ends_job(ended));
}

// Computes until it is told to stop.
class EndlessWorker : public jobs::Executor {
 public:
  explicit EndlessWorker(const slurm::AttemptFolder& shared) : shared_(shared) {}
  bool has_worker(const store::JobFolder&) override { return false; }
  std::optional<jobs::WorkerExit> read_final_report(const store::JobFolder&, const jobs::WorkerEvents&) override {
    return std::nullopt;
  }
  void end_worker(const store::JobFolder&) override {}
  jobs::WorkerExit run(const store::JobFolder&, const worker::Order&, const jobs::WorkerEvents&,
                       const jobs::Interruptions& interruptions) override {
    std::promise<void> stopped;
    const std::stop_callback on_stop(interruptions.stop, [&stopped] { stopped.set_value(); });
    was_stopped = stopped.get_future().wait_for(std::chrono::seconds(20)) == std::future_status::ready;
    shared_.request(slurm::Request::ABANDON);
    return {.kind = Kind::stopped};
  }

  bool was_stopped = false;

 private:
  const slurm::AttemptFolder& shared_;
};

TEST(AttemptRun, TheLeaseEndsWhileTheHeartbeatCannotBeWritten) {
  const TemporaryFolder temporary;
  const store::JobFolder folder(temporary.path());
  slurm::write_small_file(folder.order(), order_of(tiny_case()).SerializeAsString());
  const slurm::AttemptFolder shared(temporary.path() / "attempts" / "1");
  fs::create_directories(shared.root());
  shared.request(slurm::Request::NONE);
  // Nothing is written into a FIFO.
  ASSERT_EQ(mkfifo((shared.root() / "heartbeat").c_str(), 0600), 0);
  EndlessWorker worker(shared);
  const slurm::TaskEnd end = slurm::Ended::REASON_UNSPECIFIED;
  slurm::AttemptRun(shared, worker, end, milliseconds(300)).run(folder);
  EXPECT_TRUE(worker.was_stopped);
}

// Commands that stand in for those of Slurm.
class AttemptTest : public ::testing::Test {
 protected:
  void SetUp() override {
    options_.name = "test";
    options_.folder = temporary_.path() / "shared";
    options_.program = CELLCRUSHD_PROGRAM;
    options_.commands = temporary_.path() / "commands";
    options_.times.look = milliseconds(100);
    options_.times.squeue = milliseconds(200);
    options_.times.command = milliseconds(5'000);
    options_.times.unanswered = milliseconds(1'000);
    fs::create_directories(options_.folder);
    fs::create_directories(options_.commands);
    fs::create_directories(job_.root());
    for (const char* name : {"sbatch", "squeue", "sacct", "scancel"}) command(name, "exit 0");
    slurm::prepare_shared_folder(options_, temporary_.path());
  }

  void command(const std::string& name, const std::string& script) const {
    const auto path = options_.commands / name;
    std::ofstream(path) << "#!/bin/sh\nHERE=" << options_.commands.string() << "\n" << script << "\n";
    chmod(path.c_str(), 0755);
  }

  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream file(options_.commands / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  [[nodiscard]] static std::unique_ptr<jobs::LocalProcess> workers() {
    return std::make_unique<jobs::LocalProcess>(CELLCRUSHD_PROGRAM, std::chrono::seconds(20));
  }

  // sbatch notes the name of the job, and takes it as number 17.
  void accept_jobs() const {
    command("sbatch",
            "for word in \"$@\"; do case $word in --job-name=*) echo ${word#--job-name=} > $HERE/name;; esac; done\n"
            "echo 17");
    command("scancel", "echo \"$@\" >> $HERE/cancelled");
  }

  TemporaryFolder temporary_;
  slurm::ClusterOptions options_;
  store::JobFolder job_{temporary_.path() / "jobs/1"};
};

// The daemon ended between the copying of the last reports and the end of the job.
TEST_F(AttemptTest, AnAttemptWhoseFinalReportIsHereAlreadyEndsTheJob) {
  const auto local = workers();
  ExecutorRun computed(*local, job_, order_of(tiny_case()));
  const auto expected = computed.wait();
  ASSERT_TRUE(expected.final && expected.final->has_summary());
  const slurm::AttemptFolder shared(options_.folder / "attempts/a");
  fs::create_directories(shared.root());
  for (const auto& [from, to] :
       {std::pair(job_.order(), shared.files().order()), std::pair(job_.reports(), shared.files().reports()),
        std::pair(job_.result(), shared.files().result())})
    fs::copy_file(from, to);
  ASSERT_TRUE(shared.claim({}));
  shared.beat(1);
  slurm::Ended ended;
  ended.set_kind(slurm::Ended::EXITED);
  *ended.mutable_final() = *expected.final;
  shared.end(ended);
  slurm::Attempt attempt;
  attempt.set_id("a");
  attempt.set_batch("b");
  attempt.set_slurm_job(17);
  slurm::write_attempt(job_, attempt);
  slurm::SlurmExecutor executor(options_, 1e-8, workers());
  ExecutorRun adopted(executor, job_, order_of(tiny_case()));
  const auto exit = adopted.wait();
  EXPECT_EQ(exit.kind, Kind::exited);
  EXPECT_TRUE(exit.final && exit.final->has_summary());
  EXPECT_FALSE(shared.exists());
}

// It uploads 750 MiB for 210 elements.
TEST_F(AttemptTest, ATaskThatHandsOverMoreThanWasForecastLosesItsAttempt) {
  accept_jobs();
  command("squeue", "echo \"17|N/A|RUNNING|None|n1|$(cat $HERE/name)\"");
  slurm::SlurmExecutor executor(options_, 1e-8, workers());
  ExecutorRun run(executor, job_, order_of(tiny_case()));
  EXPECT_THAT(run.wait_for_place("RUNNING"), HasSubstr("RUNNING"));
  const slurm::AttemptFolder shared(options_.folder, slurm::read_attempt(job_)->id());
  ASSERT_TRUE(shared.claim({}));
  std::ofstream(shared.files().result()).close();
  fs::resize_file(shared.files().result(), std::uintmax_t{750} << 20);
  std::ofstream(shared.files().reports()).close();
  const auto exit = run.wait();
  EXPECT_EQ(exit.kind, Kind::gone);
  EXPECT_THAT(exit.detail, AllOf(HasSubstr("Slurm job 17 wrote too much: "),
                                 HasSubstr("result.h5 has 750 MiB; at most"), HasSubstr("were expected.")));
  EXPECT_FALSE(fs::exists(job_.result()));
  EXPECT_FALSE(shared.exists());
}

// squeue has forgotten the task that had not begun, and sacct knows why.
TEST_F(AttemptTest, AWaitingTaskThatTheAccountingKnowsAsCancelledIsNotSubmittedAgain) {
  accept_jobs();
  command("sacct", "echo \"17|CANCELLED by 0|None assigned|$(cat $HERE/name)\"");
  slurm::SlurmExecutor executor(options_, 1e-8, workers());
  ExecutorRun run(executor, job_, order_of(tiny_case()));
  const auto exit = run.wait();
  EXPECT_EQ(exit.kind, Kind::withdrawn);
  EXPECT_THAT(exit.detail, HasSubstr("CANCELLED"));
}

TEST_F(AttemptTest, AWaitingTaskOfWhichNobodyKnowsIsTakenBack) {
  accept_jobs();
  slurm::SlurmExecutor executor(options_, 1e-8, workers());
  ExecutorRun run(executor, job_, order_of(tiny_case()));
  EXPECT_EQ(run.wait().kind, Kind::displaced);
}

TEST_F(AttemptTest, ATaskWhoseJobsAreAllCancelledBeforeItBeginsIsCancelledInSlurm) {
  accept_jobs();
  command("squeue", "echo \"17|N/A|PENDING|Priority||$(cat $HERE/name)\"");
  slurm::SlurmExecutor executor(options_, 1e-8, workers());
  const store::JobFolder other(temporary_.path() / "jobs/2");
  fs::create_directories(other.root());
  ExecutorRun first(executor, job_, order_of(tiny_case()));
  ExecutorRun second(executor, other, order_of(tiny_case()));
  EXPECT_THAT(first.wait_for_place("PENDING"), HasSubstr("PENDING"));
  EXPECT_THAT(second.wait_for_place("PENDING"), HasSubstr("PENDING"));
  first.cancel();
  EXPECT_EQ(first.wait().kind, Kind::cancelled);
  EXPECT_EQ(text_of("cancelled"), "");
  second.cancel();
  EXPECT_EQ(second.wait().kind, Kind::cancelled);
  EXPECT_EQ(text_of("cancelled"), "--quiet 17\n");
  EXPECT_TRUE(fs::is_empty(options_.folder / "batches"));
}

// The order of each attempt refers to it; the task copies it to the node's disk with the order.
TEST_F(AttemptTest, AttemptsShareTheFileOfALargeLattice) {
  accept_jobs();
  command("squeue", "echo \"17|N/A|PENDING|Priority||$(cat $HERE/name)\"");
  slurm::SlurmExecutor executor(options_, 1e-8, workers());
  const store::JobFolder other(temporary_.path() / "jobs/2");
  fs::create_directories(other.root());
  const auto order = order_of(brick_network(60, 50));
  ExecutorRun first(executor, job_, order);
  ExecutorRun second(executor, other, order);
  EXPECT_THAT(first.wait_for_place("PENDING"), HasSubstr("PENDING"));
  EXPECT_THAT(second.wait_for_place("PENDING"), HasSubstr("PENDING"));
  const auto attempt = *slurm::read_attempt(job_);
  const store::JobFolder files = slurm::AttemptFolder(options_.folder, attempt.id()).files();
  EXPECT_EQ(fs::hard_link_count(files.lattice()), 3U) << "of two attempts and the shared name";
  EXPECT_LT(fs::file_size(files.order()), 4096U);
  EXPECT_EQ(
      slurm::run_task({.folder = options_.folder, .batch = attempt.batch(), .worker_program = CELLCRUSHD_PROGRAM}), 0);
  for (ExecutorRun* run : {&first, &second}) {
    const auto exit = run->wait();
    EXPECT_TRUE(exit.final && exit.final->has_summary()) << (exit.final ? exit.final->message() : exit.detail);
  }
  EXPECT_TRUE(fs::is_empty(options_.folder / "lattices"));
}

}  // namespace
}  // namespace cellcrush::testing
