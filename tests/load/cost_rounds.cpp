#include "load/cost_rounds.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <utility>

#include "load/figures.h"
#include "load/job_runs.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/sample_writer.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "store/journal.h"

namespace cellcrush::load {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kManySamples = 2000;
constexpr int kWatchers = 20;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

v1::Case case_of_samples(int samples) {
  v1::Case out = testing::small_case();
  out.mutable_output()->set_sample_count(samples);
  return out;
}

}  // namespace

// Commits of one change each, of a thousand changes, and of many samples.
void measure_journal(Rounds& rounds) {
  const testing::TemporaryFolder folder;
  constexpr int kChanges = 300;
  constexpr int kJobs = 1000;
  constexpr int kSamples = 100;
  store::Journal journal(folder.path() / "journal.sqlite", [](std::int64_t) {});
  store::SweepJob one;
  *one.job.mutable_case_() = testing::small_case();
  const auto made = journal.create_sweep({}, std::vector<store::SweepJob>(2 * kJobs, one), "", "");
  const std::vector<std::int64_t> running(made.jobs.begin(), made.jobs.begin() + kJobs);
  const std::vector<std::int64_t> others(made.jobs.begin() + kJobs, made.jobs.end());
  store::StateChange change;
  auto start = Clock::now();
  for (int i = 0; i < kChanges; ++i) {
    change.state = i % 2 == 0 ? v1::Job::SUSPENDED : v1::Job::PENDING;
    journal.change_state(running.front(), change);
  }
  const double alone = seconds_since(start) / kChanges;
  start = Clock::now();
  journal.cancel_waiting(others);
  const double together = seconds_since(start) / kJobs;
  rounds["change_s"].push_back(together);
  rounds["commit_s"].push_back(std::max(alone - together, 0.0));
  testing::SampleWriter reported(folder.path());
  v1::Sample sample;
  for (const std::int64_t job : running) {
    for (int i = 0; i < kSamples; ++i) {
      sample.set_step(i);
      sample.set_time_s(1e-5 * i);
      sample.set_strain(1e-3 * i);
      sample.set_stress_impact_mpa(1.0 / (1 + i));
      sample.set_stress_support_mpa(0.7 / (1 + i));
      sample.set_energy_kinetic_mj(1.0 + 0.1 * i);
      sample.set_energy_elastic_mj(2.0 + 0.3 * i);
      sample.set_energy_plastic_mj(3.0 + 0.7 * i);
      sample.set_energy_contact_mj(4.0 + 0.9 * i);
      sample.set_work_external_mj(5.0 + 1.1 * i);
      sample.set_energy_residual_mj(1e-3 * i);
      sample.set_deepest_penetration(1e-4 * i);
      sample.set_contact_count(i);
      reported.add(journal, job, sample);
    }
  }
  start = Clock::now();
  journal.commit_samples();
  rounds["sample_commit_s"].push_back(seconds_since(start) / (kJobs * kSamples));
}

// Jobs one after the other, with few and with many samples; the samples' costs are the difference.
void measure_runs(int jobs, Rounds& rounds) {
  const testing::TemporaryFolder few_folder;
  const testing::TemporaryFolder many_folder;
  const JobRuns few = run_jobs(few_folder.path(), testing::small_case(), jobs, 1);
  const JobRuns many = run_jobs(many_folder.path(), case_of_samples(kManySamples), jobs, 1);
  constexpr double kStates = 3.0;
  const double few_events = few.events / few.jobs - kStates;
  const double more = many.events / many.jobs - kStates - few_events;
  const auto add = [&](const char* of_sample, const char* of_job, double JobRuns::*total) {
    const double sample = std::max((many.*total / many.jobs - few.*total / few.jobs) / more, 0.0);
    rounds[of_sample].push_back(sample);
    rounds[of_job].push_back(few.*total / few.jobs - few_events * sample);
  };
  add("sample_cpu_s", "job_cpu_s", &JobRuns::daemon_s);
  add("sample_journal_bytes", "job_journal_bytes", &JobRuns::journal_bytes);
  add("sample_result_bytes", "job_result_bytes", &JobRuns::result_bytes);
  const double daemon = rounds["job_cpu_s"].back() + few_events * rounds["sample_cpu_s"].back();
  rounds["slot_gap_s"].push_back(std::max(few.makespan_s / few.jobs - few.solver_s - daemon, 0.0));
  rounds["small_run_s"].push_back(few.solver_s);
  rounds["small_run_spread"].push_back(few.solver_spread);
  rounds["small_samples"].push_back(few_events);
}

// A daemon that follows one slow job, with and without watchers, and waiting jobs behind it.
void measure_daemon(Rounds& rounds) {
  const testing::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  constexpr int kWaiting = 5000;
  constexpr double kSeconds = 5.0;
  const std::string address = "unix:" + (folder / "socket").string();
  testing::DaemonProcess daemon({"--data", (folder / "data").string(), "--listen", address, "--workers", "1"});
  if (daemon.wait_for_addresses(1).empty()) throw std::runtime_error("the daemon does not start");
  testing::Client client(address);
  v1::Case slow = testing::endless_case();
  slow.mutable_output()->set_sample_count(10);
  slow.mutable_output()->set_frame_count(2);
  const std::string first = client.create(slow);
  client.wait_for_state(first, v1::Job::RUNNING);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const auto use = [&](double seconds) {
    const double used = processor_time_of(daemon.number());
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    return (processor_time_of(daemon.number()) - used) / seconds;
  };
  rounds["follow_cpu_s"].push_back(use(kSeconds));
  client.cancel(first);
  // Watched from its first event to its last.
  v1::Case sampled = case_of_samples(kManySamples);
  const auto crush = [&](int watchers) {
    const double used = processor_time_of(daemon.number());
    const std::string job = client.create(sampled);
    std::atomic<int> events = 0;
    {
      std::vector<std::jthread> threads;
      for (int i = 0; i < watchers; ++i) {
        threads.emplace_back(
            [&] { testing::Client(address).watch(job, 0, false, [&events](const v1::JobEvent&) { ++events; }); });
      }
      client.wait_for_state(job, v1::Job::SUCCEEDED);
    }
    return std::pair(processor_time_of(daemon.number()) - used, static_cast<double>(events));
  };
  const double alone = crush(0).first;
  const auto [watched, events] = crush(kWatchers);
  rounds["watch_cpu_s"].push_back(std::max(watched - alone, 0.0) / events);
  const std::string second = client.create(testing::endless_case());
  client.wait_for_state(second, v1::Job::RUNNING);
  const double memory = memory_of(daemon.number());
  const double journal = journal_bytes_in(folder / "data" / "journal.sqlite");
  std::vector<double> speeds;
  for (int i = 0; i < kWaiting; ++i) speeds.push_back(50.0 + 0.01 * i);
  testing::create(client, testing::sweep_of(testing::small_case(), testing::kSpeed, speeds));
  rounds["waiting_memory_bytes"].push_back((memory_of(daemon.number()) - memory) * 1024.0 * 1024.0 / kWaiting);
  rounds["waiting_journal_bytes"].push_back((journal_bytes_in(folder / "data" / "journal.sqlite") - journal) /
                                            kWaiting);
  testing::kill_workers(folder / "data");
}

std::map<std::string, double> medians_of(const Rounds& rounds) {
  std::map<std::string, double> out;
  for (auto [name, values] : rounds) {
    std::sort(values.begin(), values.end());
    out[name] = values[values.size() / 2];
  }
  return out;
}

}  // namespace cellcrush::load
