// Measures one daemon with a sweep of 100,000 points, on this machine: accepted, listed, watched, cancelled, deleted by
// retention, and a restart. Prints a figure a line; asserts nothing.
// usage: scale_load [POINTS]
#include <fmt/core.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <thread>

#include "cellcrush/v1/admin_service.grpc.pb.h"
#include "load/call_probe.h"
#include "load/figures.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::load {
namespace {

using Clock = std::chrono::steady_clock;
using testing::Client;

constexpr std::chrono::seconds kLongestCall{600};
constexpr const char* kSweep = "sweeps/1";
constexpr int kInFront = 20;  // jobs of about a minute

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::unique_ptr<grpc::ClientContext> context() { return testing::bounded_context(kLongestCall); }

void report_failure(const char* call, const grpc::Status& status) {
  if (!status.ok()) fmt::print("{} failed: {}\n", call, status.error_message());
}

double megabytes_of(const std::filesystem::path& file) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  return none ? 0.0 : 1e-6 * static_cast<double>(size);
}

// A daemon process on a data folder, and what it costs.
class Measured {
 public:
  Measured(std::filesystem::path folder, const std::vector<std::string>& more = {}) : folder_(std::move(folder)) {
    std::vector<std::string> arguments = {"--data", data().string(), "--listen", address(), "--workers", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto start = Clock::now();
    process_.emplace(arguments);
    if (process_->wait_for_addresses(1).empty()) fmt::print("the daemon does not start\n");
    const auto channel = grpc::CreateChannel(address(), grpc::InsecureChannelCredentials());
    v1::ListJobsRequest request;
    request.set_page_size(1);
    v1::ListJobsResponse page;
    report_failure("ListJobs", v1::Jobs::NewStub(channel)->ListJobs(context().get(), request, &page));
    answered_ = seconds_since(start);
  }

  void print_start(const char* with) const {
    fmt::print("start of a daemon with {}: it answers after {:.2f} s, resident {:.0f} MiB\n", with, answered_,
               memory_of(process_->number()));
  }

  void print_memory(const char* when) const {
    fmt::print("  memory {}: resident {:.0f} MiB, PSS {:.0f} MiB, at most {:.0f} MiB\n", when,
               memory_of(process_->number()), shared_memory_of(process_->number()), peak_memory_of(process_->number()));
  }

  void print_disk(const char* when) const {
    fmt::print("  journal {}: {:.1f} MB and a log of {:.1f} MB\n", when, megabytes_of(data() / "journal.sqlite"),
               megabytes_of(data() / "journal.sqlite-wal"));
  }

  void kill() { process_.reset(); }
  [[nodiscard]] double processor_time() const { return processor_time_of(process_->number()); }
  [[nodiscard]] double memory() const { return memory_of(process_->number()); }
  [[nodiscard]] std::string address() const { return "unix:" + (folder_ / "socket").string(); }
  [[nodiscard]] std::filesystem::path data() const { return folder_ / "data"; }

 private:
  std::filesystem::path folder_;
  std::optional<testing::DaemonProcess> process_;
  double answered_ = 0.0;
};

// Jobs of about a minute each, so that all others wait.
void occupy(Client& client) {
  v1::CreateJobRequest request;
  *request.mutable_case_() = testing::endless_case();
  request.set_priority(100);
  v1::Job job;
  for (int i = 0; i < kInFront; ++i)
    report_failure("CreateJob", client.jobs->CreateJob(context().get(), request, &job));
  client.wait_for_state("jobs/1", v1::Job::RUNNING);
}

v1::CreateSweepRequest sweep_of_points(int points) {
  v1::CreateSweepRequest request;
  *request.mutable_sweep()->mutable_case_() = testing::small_case();
  (*request.mutable_sweep()->mutable_labels())["batch"] = "scale";
  auto& axis = *request.mutable_sweep()->add_axes();
  axis.set_field(testing::kSpeed);
  axis.mutable_linear()->set_first(50.0);
  axis.mutable_linear()->set_last(150.0);
  axis.mutable_linear()->set_count(points);
  return request;
}

void accept(Measured& daemon, Client& client, CallProbe& probe, int points) {
  daemon.print_memory("before");
  daemon.print_disk("before");
  probe.print("before");
  const auto start = Clock::now();
  v1::Sweep sweep;
  const auto status = client.sweeps->CreateSweep(context().get(), sweep_of_points(points), &sweep);
  report_failure("CreateSweep", status);
  fmt::print("a sweep of {} points is queued in {:.2f} s; its answer has {:.2f} MB\n", points, seconds_since(start),
             1e-6 * static_cast<double>(sweep.ByteSizeLong()));
  probe.print("during the submit");
  daemon.print_memory("with the jobs waiting");
  daemon.print_disk("with the jobs waiting");
}

std::vector<v1::ListJobsResponse> list(Client& client, const std::string& filter) {
  v1::ListJobsRequest request;
  request.set_page_size(1000);
  request.set_filter(filter);
  std::vector<v1::ListJobsResponse> out;
  do {
    v1::ListJobsResponse& page = out.emplace_back();
    const auto status = client.jobs->ListJobs(context().get(), request, &page);
    report_failure("ListJobs", status);
    if (!status.ok()) break;
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return out;
}

// The time of a page of 50 in the middle of all.
std::vector<double> time_middle(Client& client, const std::string& filter, const std::string& token) {
  std::vector<double> out;
  for (int i = 0; i < 20; ++i) {
    v1::ListJobsRequest request;
    request.set_filter(filter);
    request.set_page_size(1000);
    request.set_page_token(token);
    v1::ListJobsResponse page;
    const auto start = Clock::now();
    report_failure("ListJobs", client.jobs->ListJobs(context().get(), request, &page));
    out.push_back(seconds_since(start));
  }
  return out;
}

void read_lists(Client& client, CallProbe& probe) {
  probe.print("before the lists");
  for (const char* filter : {"", "state = PENDING", "label.batch = scale", "title : \"= 99.\"", "owner = nobody"}) {
    const auto start = Clock::now();
    const auto pages = list(client, filter);
    std::size_t jobs = 0;
    for (const auto& page : pages) jobs += static_cast<std::size_t>(page.jobs_size());
    fmt::print("ListJobs \"{}\": {} jobs in {} pages of up to 1000 take {:.2f} s\n", filter, jobs, pages.size(),
               seconds_since(start));
    const std::string& token = pages[pages.size() / 2].next_page_token();
    if (!token.empty()) fmt::print("  a page in the middle, {}\n", describe(time_middle(client, filter, token)));
  }
  probe.print("during the lists");
  auto start = Clock::now();
  for (int i = 0; i < 10; ++i) testing::get_sweep(client, kSweep);
  fmt::print("GetSweep takes {:.3f} s\n", 0.1 * seconds_since(start));
  v1::GetSweepTableRequest request;
  request.set_name(kSweep);
  int pages = 0;
  start = Clock::now();
  do {
    v1::SweepTable table;
    report_failure("GetSweepTable", client.sweeps->GetSweepTable(context().get(), request, &table));
    request.set_page_token(table.next_page_token());
    ++pages;
  } while (!request.page_token().empty());
  fmt::print("GetSweepTable: {} pages take {:.2f} s\n", pages, seconds_since(start));
  const auto admin = v1::Admin::NewStub(client.channel);
  v1::Queue queue;
  start = Clock::now();
  report_failure("GetQueue", admin->GetQueue(context().get(), {}, &queue));
  fmt::print("GetQueue takes {:.3f} s\n", seconds_since(start));
  probe.print("during GetSweep, GetSweepTable and GetQueue");
}

// Watches until each job of the sweep has sent its snapshot and its state, or so many messages have come.
void watch(Measured& daemon, CallProbe& probe, int messages) {
  probe.print("before the watches");
  for (const int watchers : {1, 4}) {
    const double before = daemon.memory();
    const double used = daemon.processor_time();
    const auto start = Clock::now();
    std::vector<std::unique_ptr<Client>> clients;
    std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
    std::vector<std::unique_ptr<grpc::ClientReader<v1::WatchSweepResponse>>> readers;
    v1::WatchSweepRequest request;
    request.set_name(kSweep);
    v1::WatchSweepResponse response;
    for (int i = 0; i < watchers; ++i) {
      clients.push_back(std::make_unique<Client>(daemon.address()));
      contexts.push_back(context());
      readers.push_back(clients.back()->sweeps->WatchSweep(contexts.back().get(), request));
      if (!readers.back()->Read(&response)) fmt::print("a watch ended\n");
    }
    const double first = seconds_since(start);
    std::vector<std::jthread> threads;
    for (auto& reader : readers) {
      threads.emplace_back([&reader, messages] {
        v1::WatchSweepResponse event;
        for (int i = 0; i < messages && reader->Read(&event);) i += event.has_event() && !event.event().has_bookmark();
      });
    }
    threads.clear();
    fmt::print(
        "{} WatchSweep: its snapshot after {:.2f} s, {} events of the jobs after {:.2f} s; {:.1f} s of the "
        "daemon, {:.0f} MiB more\n",
        watchers, first / watchers, messages, seconds_since(start), daemon.processor_time() - used,
        daemon.memory() - before);
    for (auto& each : contexts) each->TryCancel();
    for (auto& reader : readers) {
      while (reader->Read(&response)) {
      }
      reader->Finish();
    }
  }
  probe.print("during the WatchSweep");
  const auto start = Clock::now();
  Client client(daemon.address());
  const auto one = context();
  const auto reader = client.jobs->WatchJobs(one.get(), {});
  v1::WatchJobsResponse response;
  reader->Read(&response);
  fmt::print("WatchJobs: its snapshot after {:.3f} s\n", seconds_since(start));
  one->TryCancel();
  while (reader->Read(&response)) {
  }
  reader->Finish();
}

void cancel(Measured& daemon, Client& client, CallProbe& probe) {
  probe.print("before the cancelling");
  v1::CancelSweepRequest request;
  request.set_name(kSweep);
  v1::Sweep sweep;
  const auto start = Clock::now();
  report_failure("CancelSweep", client.sweeps->CancelSweep(context().get(), request, &sweep));
  fmt::print("CancelSweep takes {:.2f} s: {} are CANCELLED\n", seconds_since(start),
             testing::count_in(sweep, v1::Job::CANCELLED));
  probe.print("during CancelSweep");
  daemon.print_memory("with the jobs cancelled");
  daemon.print_disk("with the jobs cancelled");
}

// Until no job of the sweep is there.
void retain(const std::filesystem::path& folder) {
  Measured daemon(folder, {"--keep-ended-count", "10"});
  daemon.print_start("the jobs ended and --keep-ended-count");
  // The last job in front has not ended, and is not deleted.
  CallProbe probe(daemon.address(), "jobs/" + std::to_string(kInFront));
  Client client(daemon.address());
  const auto start = Clock::now();
  v1::ListJobsRequest request;
  request.set_filter("label.batch = scale");
  request.set_page_size(1);
  v1::ListJobsResponse left;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    left.Clear();
    report_failure("ListJobs", client.jobs->ListJobs(context().get(), request, &left));
  } while (left.jobs_size() > 0 && seconds_since(start) < 300.0);
  fmt::print("retention by count deletes the sweep's jobs in {:.1f} s, with {:.1f} s of the daemon\n",
             seconds_since(start), daemon.processor_time());
  probe.print("during retention");
  std::this_thread::sleep_for(std::chrono::seconds(6));
  daemon.print_disk("6 s later");
  daemon.print_memory("after retention");
}

void measure(const std::filesystem::path& folder, int points) {
  std::optional<Measured> daemon;
  {
    daemon.emplace(folder, std::vector<std::string>{"--max-queued-jobs", "1000000"});
    daemon->print_start("no job");
    Client client(daemon->address());
    occupy(client);
    CallProbe probe(daemon->address(), "jobs/1");
    accept(*daemon, client, probe, points);
    read_lists(client, probe);
    watch(*daemon, probe, points);
  }
  daemon->kill();
  daemon.emplace(folder, std::vector<std::string>{"--max-queued-jobs", "1000000"});
  daemon->print_start("the jobs waiting, after a kill");
  {
    Client client(daemon->address());
    CallProbe probe(daemon->address(), "jobs/1");
    cancel(*daemon, client, probe);
    read_lists(client, probe);
  }
  daemon->kill();
  daemon.emplace(folder);
  daemon->print_start("the jobs ended, after a kill");
  daemon->kill();
  daemon.reset();
  retain(folder);
}

}  // namespace
}  // namespace cellcrush::load

int main(int count, char** words) {
  const int points = count > 1 ? std::atoi(words[1]) : 100'000;
  const cellcrush::testing::TemporaryFolder folder;
  cellcrush::load::measure(folder.path(), points);
  cellcrush::testing::kill_workers(folder.path() / "data");
  return 0;
}
