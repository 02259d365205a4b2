// Measures the service under load, on this machine, while jobs run. Prints a figure a line; asserts nothing.
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "faults/fault_fixture.h"
#include "load/figures.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"

namespace cellcrush::load {
namespace {

using Clock = std::chrono::steady_clock;
using testing::Client;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Submits jobs one after the other that wait behind all others; the times that the calls took.
std::vector<double> submit(const std::string& address, int count, std::vector<std::string>* names = nullptr) {
  Client client(address);
  auto request = testing::job_of(testing::small_case());
  request.set_priority(-100);
  std::vector<double> out;
  for (int i = 0; i < count; ++i) {
    v1::Job job;
    const auto start = Clock::now();
    const auto status = client.jobs->CreateJob(testing::bounded_context().get(), request, &job);
    out.push_back(seconds_since(start));
    if (!status.ok()) fmt::print("a submit failed: {}\n", status.error_message());
    if (names != nullptr) names->push_back(job.name());
  }
  return out;
}

void measure_submits(const std::string& address) {
  const auto start = Clock::now();
  fmt::print("durable submits of one client, {}\n", describe(submit(address, 1000)));
  fmt::print("  that is {:.0f} a second\n", 1000.0 / seconds_since(start));
  const auto together = Clock::now();
  constexpr int kClients = 8;
  std::vector<std::jthread> clients;
  clients.reserve(kClients);
  for (int i = 0; i < kClients; ++i) clients.emplace_back([&address] { submit(address, 250); });
  clients.clear();
  fmt::print("durable submits of eight clients: {:.0f} a second\n", 2000.0 / seconds_since(together));
}

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

// Lists with each kind of filter from a journal of 200000 jobs, of which few or none match, so that all are searched.
void measure_lists(const std::filesystem::path& folder) {
  constexpr int kJobs = 200'000;
  testing::fill_journal(folder / "many", kJobs, testing::small_case());
  const std::string address = "unix:" + (folder / "many-socket").string();
  testing::DaemonProcess daemon({"--data", (folder / "many").string(), "--listen", address, "--workers", "1",
                                 "--max-queued-jobs", "1000000", "--log-format", "json"});
  if (daemon.wait_for_addresses(1).empty()) {
    fmt::print("the daemon does not start on {} jobs\n", kJobs);
    return;
  }
  Client client(address);
  for (const char* filter :
       {"", "state = RUNNING", "owner = nobody", "label.batch = none", "title : \"no such title\""}) {
    std::vector<double> taken;
    for (int i = 0; i < 20; ++i) {
      v1::ListJobsRequest request;
      request.set_filter(filter);
      const auto start = Clock::now();
      const auto status = client.try_to(request);
      taken.push_back(seconds_since(start));
      if (!status.ok()) fmt::print("a list failed: {}\n", status.error_message());
    }
    fmt::print("a list of 200000 jobs with the filter \"{}\", {}\n", filter, describe(std::move(taken)));
  }
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

int measure(const std::filesystem::path& folder) {
  const std::string address = "unix:" + (folder / "socket").string();
  testing::DaemonProcess daemon(
      {"--data", (folder / "data").string(), "--listen", address, "--workers", "1", "--log-format", "json"});
  if (daemon.wait_for_addresses(1).empty()) {
    fmt::print("the daemon does not start\n");
    return 1;
  }
  measure_runs(address, daemon.number());
  Client client(address);
  const std::string busy = client.create(testing::endless_case());
  client.wait_for_state(busy, v1::Job::RUNNING);
  measure_submits(address);
  measure_events(address);
  fmt::print("the daemon's memory: {:.0f} MiB\n", memory_of(daemon.number()));
  client.cancel(busy);
  measure_lists(folder);
  return 0;
}

}  // namespace
}  // namespace cellcrush::load

int main() {
  const cellcrush::testing::TemporaryFolder folder;
  const int result = cellcrush::load::measure(folder.path());
  for (const char* data : {"data", "many"}) cellcrush::testing::kill_workers(folder.path() / data);
  return result;
}
