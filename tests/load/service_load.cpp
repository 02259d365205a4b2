// Measures the service under load, on this machine, while jobs run. Prints a figure a line; asserts nothing.
#include <absl/cleanup/cleanup.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "load/figures.h"
#include "load/journal_load.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"

namespace cellcrush::load {
namespace {

using Clock = std::chrono::steady_clock;
using testing::Client;

// Two watchers on each of a hundred waiting jobs, which are then cancelled: from before the call to the watcher, with
// the call, the change and its commit.
void measure_events(const std::string& address) {
  std::vector<std::string> jobs;
  submit(address, 100, &jobs);
  std::vector<std::atomic<Clock::time_point>> called(jobs.size());
  std::mutex mutex;
  std::vector<double> latencies;
  std::atomic<int> watching = 0;
  {
    std::vector<std::jthread> watchers;
    for (std::size_t i = 0; i < 2 * jobs.size(); ++i) {
      watchers.emplace_back([&, i] {
        Client(address).watch(jobs[i / 2], 0, false, [&](const v1::JobEvent& event) {
          if (event.has_snapshot()) ++watching;
          if (!event.has_state() || event.state().state() != v1::Job::CANCELLED) return;
          const double taken = seconds_since(called[i / 2].load());
          const std::scoped_lock lock(mutex);
          latencies.push_back(taken);
        });
      });
    }
    while (watching < 200) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    Client client(address);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      called[i] = Clock::now();
      client.cancel(jobs[i]);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  fmt::print("from a call to cancel to 200 watchers of 100 jobs, {}\n", describe(std::move(latencies)));
}

// Type I for some ten thousand steps, with about ten frames a second of some 120 kB.
v1::Case framed_case(Client& client) {
  v1::Case out = client.preset("type-i");
  out.mutable_loading()->set_end_strain(0.3);
  out.mutable_output()->set_frame_count(60);
  return out;
}

struct Run {
  double solver_seconds = 0.0;
  double daemon_seconds = 0.0;
  double clock_seconds = 0.0;
  std::size_t frames = 0;
};

// Waits without costing the daemon what a watch does.
void wait_for_end(Client& client, const std::string& job) {
  while (client.get(job).state() != v1::Job::SUCCEEDED) std::this_thread::sleep_for(std::chrono::milliseconds(500));
}

// A watcher of a job and its frames that reads a message a second for as long as it lives.
class SlowWatcher {
 public:
  SlowWatcher(const std::string& address, const std::string& job) : client_(address) {
    auto request = testing::named<v1::WatchJobRequest>(job);
    request.set_frames(true);
    reader_ = client_.jobs->WatchJob(context_.get(), request);
    thread_ = std::jthread([this](const std::stop_token& stop) {
      v1::JobEvent event;
      while (!stop.stop_requested() && reader_->Read(&event)) std::this_thread::sleep_for(std::chrono::seconds(1));
    });
  }
  ~SlowWatcher() {
    context_->TryCancel();
    thread_.request_stop();
  }
  SlowWatcher(const SlowWatcher&) = delete;
  SlowWatcher& operator=(const SlowWatcher&) = delete;

 private:
  Client client_;
  std::unique_ptr<grpc::ClientContext> context_ = testing::bounded_context();
  std::unique_ptr<grpc::ClientReader<v1::JobEvent>> reader_;
  std::jthread thread_;
};

struct Watchers {
  int count = 0;
  bool frames = false;
  bool slow = false;  // one more, that reads a message a second
};

Run run(const std::string& address, int daemon, const Watchers& watchers) {
  Client client(address);
  Run out;
  const auto start = Clock::now();
  const double before = processor_time_of(daemon);
  auto request = testing::job_of(framed_case(client));
  request.set_priority(100);
  const v1::Job job = client.create(request);
  std::atomic<std::size_t> seen = 0;
  {
    std::vector<std::jthread> threads;
    threads.reserve(watchers.count);
    std::optional<SlowWatcher> slow;
    if (watchers.slow) slow.emplace(address, job.name());
    for (int i = 0; i < watchers.count; ++i) {
      threads.emplace_back([&] {
        Client(address).watch(job.name(), 0, watchers.frames,
                              [&seen](const v1::JobEvent& event) { seen += event.has_frame(); });
      });
    }
    wait_for_end(client, job.name());
  }
  out.clock_seconds = seconds_since(start);
  out.daemon_seconds = processor_time_of(daemon) - before;
  out.solver_seconds = client.get(job.name()).summary().solver_seconds();
  out.frames = seen;
  return out;
}

void add(Run& sum, const Run& one) {
  sum.solver_seconds += one.solver_seconds;
  sum.daemon_seconds += one.daemon_seconds;
  sum.clock_seconds += one.clock_seconds;
  sum.frames += one.frames;
}

void print_share(const char* of_what, const Run& sum, int count) {
  fmt::print("  {}: {:.0f} ms, {:.2f} % of the solver's\n", of_what, 1e3 * sum.daemon_seconds / count,
             100.0 * sum.daemon_seconds / sum.solver_seconds);
}

void measure_runs(const std::string& address, int daemon) {
  constexpr int kRounds = 5;
  Run alone;
  Run watched;
  Run crowded;
  std::vector<double> slowed;
  for (int i = 0; i < kRounds; ++i) {
    const Run by_itself = run(address, daemon, {});
    slowed.push_back(run(address, daemon, {0, false, true}).solver_seconds / by_itself.solver_seconds);
    add(alone, by_itself);
    add(watched, run(address, daemon, {1}));
    add(crowded, run(address, daemon, {200, true}));
  }
  std::sort(slowed.begin(), slowed.end());
  fmt::print("Type I to 30 %, {:.2f} s of the solver, mean of {}; the daemon's processor time\n",
             alone.solver_seconds / kRounds, kRounds);
  print_share("with nobody watching", alone, kRounds);
  print_share("with one watch", watched, kRounds);
  fmt::print(
      "  beside a watcher that reads a message a second the solver takes {:.2f} times as long, median of {} pairs "
      "({:.2f} to {:.2f})\n",
      slowed[kRounds / 2], kRounds, slowed.front(), slowed.back());
  print_share("with 200 watches of its frames", crowded, kRounds);
  fmt::print("  the solver then takes {:.2f} times as long, and each is sent {:.1f} frames a second\n",
             crowded.solver_seconds / alone.solver_seconds,
             static_cast<double>(crowded.frames) / 200.0 / crowded.clock_seconds);
}

// A daemon whose only worker is busy.
void measure_busy(const std::set<std::string>& parts, const std::filesystem::path& folder, Record& record) {
  const std::string address = "unix:" + (folder / "socket").string();
  const testing::DaemonProcess daemon = start_daemon(folder / "data", address);
  if (parts.contains("runs")) measure_runs(address, daemon.number());
  Client client(address);
  const std::string busy = client.create(testing::endless_case());
  client.wait_for_state(busy, v1::Job::RUNNING);
  if (parts.contains("submits")) measure_submits(address, daemon.number(), record);
  if (parts.contains("events")) measure_events(address);
  if (parts.contains("sweep")) measure_sweep(address, daemon.number(), record);
  fmt::print("the daemon's memory: {:.0f} MiB\n", memory_of(daemon.number()));
  client.cancel(busy);
}

int measure(std::vector<std::string> words) {
  const std::set<std::string> known{"runs", "submits", "events", "sweep", "many"};
  const bool is_recorded = std::erase(words, "--record") > 0;
  std::set<std::string> parts(words.begin(), words.end());
  if (!std::includes(known.begin(), known.end(), parts.begin(), parts.end())) {
    fmt::print(stderr, "usage: service_load [--record] [{}]...\n", fmt::join(known, "|"));
    return 2;
  }
  if (parts.empty()) parts = known;
  const testing::TemporaryFolder folder;
  Record record("service_load");
  const absl::Cleanup end = [&folder] {
    for (const char* data : {"data", "many"}) testing::kill_workers(folder.path() / data);
  };
  if (parts != std::set<std::string>{"many"}) measure_busy(parts, folder.path(), record);
  if (parts.contains("many")) measure_many_jobs(folder.path(), record);
  if (is_recorded) record.write(CELLCRUSH_LOAD_EVIDENCE);
  return 0;
}

}  // namespace
}  // namespace cellcrush::load

int main(int count, char** words) {
  try {
    return cellcrush::load::measure({words + 1, words + count});
  } catch (const std::exception& error) {
    fmt::print(stderr, "service_load: {}\n", error.what());
    return 1;
  }
}
