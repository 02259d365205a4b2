#include "slurm/slurm_fixture.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "slurm/attempt_folder.h"

namespace cellcrush::testing {
namespace {

using std::chrono::milliseconds;

std::unique_ptr<jobs::LocalProcess> local_process() {
  return std::make_unique<jobs::LocalProcess>(CELLCRUSHD_PROGRAM, std::chrono::seconds(20));
}

}  // namespace

void SlurmFixture::SetUp() {
  if (!slurm_is_installed()) GTEST_SKIP() << kSlurmIsMissing;
}

void SlurmFixture::start_cluster(const SlurmOptions& options) {
  cluster_ = std::make_unique<SlurmCluster>(options);
  setenv("SLURM_CONF", cluster_->config().c_str(), 1);
}

slurm::ClusterOptions SlurmFixture::quick_options() const {
  slurm::ClusterOptions out;
  out.name = "test";
  out.folder = cluster_->shared_folder() / "cellcrush";
  out.program = CELLCRUSHD_PROGRAM;
  out.task_length = std::chrono::seconds(0);
  out.times.look = milliseconds(100);
  out.times.squeue = milliseconds(2'000);
  out.times.command = milliseconds(10'000);
  out.times.silent = milliseconds(8'000);
  out.times.lease = milliseconds(12'000);
  out.times.leave = milliseconds(20'000);
  out.times.unanswered = milliseconds(10'000);
  return out;
}

void SlurmFixture::start_executor(const slurm::ClusterOptions& options) {
  executor_.reset();
  std::filesystem::create_directories(options.folder);
  slurm::prepare_shared_folder(options, folder_.path());
  executor_ = std::make_unique<slurm::SlurmExecutor>(options, 1e-8, local_process());
}

store::JobFolder SlurmFixture::job_folder(int number) const {
  store::JobFolder out(folder_.path() / "jobs" / std::to_string(number));
  std::filesystem::create_directories(out.root());
  return out;
}

std::unique_ptr<ExecutorRun> SlurmFixture::run(const v1::Case& submitted, int number) {
  return std::make_unique<ExecutorRun>(*executor_, job_folder(number), order_of(submitted));
}

std::unique_ptr<ExecutorRun> SlurmFixture::run_and_kill_task() {
  auto out = run(endless_case());
  const pid_t task = out->wait_for_start();
  EXPECT_GT(task, 0) << "The job has not begun.";
  if (task > 0) {
    EXPECT_EQ(kill(task, SIGKILL), 0);
  }
  return out;
}

std::vector<std::string> SlurmFixture::local_samples(const v1::Case& submitted) {
  const auto workers = local_process();
  ExecutorRun local(*workers, job_folder(1000), order_of(submitted));
  EXPECT_EQ(local.wait().code, 0);
  return local.samples();
}

std::size_t SlurmFixture::attempt_count() const {
  const std::filesystem::directory_iterator begin(quick_options().folder / "attempts");
  return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator{}));
}

std::filesystem::path SlurmFixture::replace_command(const std::string& name, const std::string& script) {
  const auto folder = folder_.path() / "commands";
  std::filesystem::create_directories(folder);
  for (const std::string command : {"sbatch", "squeue", "sacct", "scancel"}) {
    if (command != name && !std::filesystem::exists(folder / command))
      std::filesystem::create_symlink("/usr/bin/" + command, folder / command);
  }
  std::filesystem::remove(folder / name);
  std::ofstream(folder / name) << "#!/bin/sh\nREAL=/usr/bin/" << name << "\nHERE=" << folder.string() << "\n"
                               << script << "\n";
  chmod((folder / name).c_str(), 0755);
  return folder;
}

std::filesystem::path SlurmFixture::logging_program() const {
  const auto out = folder_.path() / "logging";
  std::ofstream(out) << "#!/bin/sh\nexec " << CELLCRUSHD_PROGRAM << " \"$@\" 2>>" << (folder_.path() / "log").string()
                     << "\n";
  chmod(out.c_str(), 0755);
  return out;
}

int SlurmFixture::count_in_log(const std::string& words, int expected) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  for (;;) {
    std::ifstream file(folder_.path() / "log");
    int out = 0;
    for (std::string line; std::getline(file, line);) out += line.find(words) != std::string::npos ? 1 : 0;
    if (out >= expected || std::chrono::steady_clock::now() > end) return out;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

v1::Case slow_case() {
  v1::Case out = case_of_seconds();
  out.mutable_loading()->set_speed_m_per_s(0.3);
  out.mutable_loading()->clear_end_time_s();
  return out;
}

std::vector<std::string> without_repeats(const std::vector<std::string>& samples) {
  std::vector<std::string> out;
  for (const auto& sample : samples) {
    if (std::find(out.begin(), out.end(), sample) == out.end()) out.push_back(sample);
  }
  return out;
}

}  // namespace cellcrush::testing
