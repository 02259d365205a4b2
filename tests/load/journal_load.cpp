// What jobs cost that wait: submits, a large sweep, a start with many jobs.
#include "load/journal_load.h"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::load {
namespace {

using testing::Client;

constexpr int kPoints = 10'000;
constexpr int kJobs = 200'000;

void measure_lists(const std::string& address) {
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
    fmt::print("a list of {} jobs with the filter \"{}\", {}\n", kJobs, filter, describe(std::move(taken)));
  }
}

// MiB, once the memory of the start is returned.
double memory_at_rest(int daemon) {
  std::this_thread::sleep_for(std::chrono::seconds(3));
  return memory_of(daemon);
}

}  // namespace

testing::DaemonProcess start_daemon(const std::filesystem::path& data_folder, const std::string& address) {
  testing::DaemonProcess daemon({"--data", data_folder.string(), "--listen", address, "--workers", "1",
                                 "--max-queued-jobs", "1000000", "--log-format", "json"});
  if (daemon.wait_for_addresses(1).empty()) throw std::runtime_error("the daemon does not start");
  return daemon;
}

std::vector<double> submit(const std::string& address, int count, std::vector<std::string>* names) {
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

void measure_submits(const std::string& address, int daemon, Record& record) {
  const double before = processor_time_of(daemon);
  const auto start = Clock::now();
  auto taken = submit(address, 1000);
  record.add("submits of one client a second", 1000.0 / seconds_since(start), 0);
  record.add("median of a submit in ms", 1e3 * at_share(taken, 0.5), 2);
  record.add("99th percentile of a submit in ms", 1e3 * at_share(taken, 0.99), 1);
  record.add("processor ms of a submit", processor_time_of(daemon) - before, 2);
  const auto together = Clock::now();
  constexpr int kClients = 8;
  std::vector<std::jthread> clients;
  clients.reserve(kClients);
  for (int i = 0; i < kClients; ++i) clients.emplace_back([&address] { submit(address, 250); });
  clients.clear();
  record.add("submits of eight clients a second", 2000.0 / seconds_since(together), 0);
}

void measure_sweep(const std::string& address, int daemon, Record& record) {
  Client client(address);
  std::vector<double> speeds;
  for (int i = 0; i < kPoints; ++i) speeds.push_back(50.0 + 0.01 * i);
  auto request = testing::sweep_of(testing::small_case(), testing::kSpeed, speeds);
  request.mutable_sweep()->set_priority(-100);
  const auto measure = [&](const std::string& what, const auto& act) {
    const double before = processor_time_of(daemon);
    const auto start = Clock::now();
    act();
    record.add("seconds to " + what + " a sweep", seconds_since(start), 2);
    record.add("processor seconds to " + what + " a sweep", processor_time_of(daemon) - before, 2);
  };
  std::string name;
  measure("create", [&] { name = testing::create(client, request).name(); });
  measure("cancel", [&] { testing::cancel_sweep(client, name); });
  measure("delete", [&] {
    testing::answer_of(*client.sweeps, &v1::Sweeps::Stub::DeleteSweep, testing::named<v1::DeleteSweepRequest>(name));
  });
}

void measure_many_jobs(const std::filesystem::path& folder, Record& record) {
  const std::string address = "unix:" + (folder / "many-socket").string();
  double idle = 0.0;
  {
    const auto daemon = start_daemon(folder / "none", address);
    idle = memory_at_rest(daemon.number());
    record.add("memory of an idle daemon in MB", 1.048576 * idle, 0);
  }
  testing::fill_journal(folder / "many", kJobs, testing::small_case());
  const auto start = Clock::now();
  const auto daemon = start_daemon(folder / "many", address);
  record.add("seconds to start", seconds_since(start), 2);
  record.add("processor seconds to start", processor_time_of(daemon.number()), 2);
  record.add("bytes of memory of a waiting job", 1048576.0 * (memory_at_rest(daemon.number()) - idle) / kJobs, 0);
  measure_lists(address);
}

}  // namespace cellcrush::load
