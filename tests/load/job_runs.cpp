#include "load/job_runs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "load/figures.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/sweep_requests.h"
#include "store/sqlite.h"

namespace cellcrush::load {
namespace {

using testing::bounded_context;

void expect_ok(const grpc::Status& status) {
  if (!status.ok()) throw std::runtime_error(status.error_message());
}

v1::CreateSweepRequest seeds_of(const v1::Case& submitted, int jobs) {
  v1::CreateSweepRequest request;
  *request.mutable_sweep()->mutable_case_() = submitted;
  auto& seeds = *request.mutable_sweep()->add_axes();
  seeds.set_field("lattice.imperfection.seed");
  seeds.set_seed_count(jobs);
  return request;
}

// Looks at the last job, which starts last, as all are predicted to run as long: 20 calls a second of 0.1 ms.
void wait_for_end(testing::Client& client, const v1::Sweep& sweep) {
  const std::string& last = sweep.jobs(sweep.jobs_size() - 1);
  while (client.get(last).state() != v1::Job::SUCCEEDED) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  if (!testing::wait_for_count(client, sweep.name(), v1::Job::SUCCEEDED, sweep.jobs_size()))
    throw std::runtime_error("a job of " + sweep.name() + " did not succeed");
}

void add_solver_times(testing::Client& client, const v1::Sweep& sweep, JobRuns& out) {
  v1::GetSweepTableRequest request;
  request.set_name(sweep.name());
  double squares = 0.0;
  do {
    v1::SweepTable table;
    expect_ok(client.sweeps->GetSweepTable(bounded_context().get(), request, &table));
    for (const auto& row : table.rows()) {
      const double solver = row.result().summary().solver_seconds();
      out.solver_s += solver;
      squares += solver * solver;
      ++out.jobs;
    }
    request.set_page_token(table.next_page_token());
  } while (!request.page_token().empty());
  out.solver_s /= out.jobs;
  out.solver_spread = std::sqrt(std::max(squares / out.jobs - out.solver_s * out.solver_s, 0.0)) / out.solver_s;
}

}  // namespace

double journal_bytes_in(const std::filesystem::path& journal) {
  store::Database database(journal);
  store::Statement read(database,
                        "SELECT (page_count - freelist_count) * page_size "
                        "FROM pragma_page_count, pragma_freelist_count, pragma_page_size");
  return read.step() ? static_cast<double>(read.integer(0)) : 0.0;
}

JobRuns run_jobs(const std::filesystem::path& folder, const v1::Case& submitted, int jobs, int workers) {
  const std::filesystem::path data = folder / "data";
  const std::filesystem::path journal_file = data / "journal.sqlite";
  const std::string address = "unix:" + (folder / "socket").string();
  testing::DaemonProcess daemon({"--data", data.string(), "--listen", address, "--workers", std::to_string(workers),
                                 "--max-queued-jobs", "1000000"});
  if (daemon.wait_for_addresses(1).empty()) throw std::runtime_error("the daemon does not start");
  testing::Client client(address);
  JobRuns out;
  // The daemon is done with its own start.
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const double journal = journal_bytes_in(journal_file);
  const double used = processor_time_of(daemon.number());
  v1::Sweep sweep;
  const auto start = std::chrono::steady_clock::now();
  expect_ok(client.sweeps->CreateSweep(bounded_context().get(), seeds_of(submitted, jobs), &sweep));
  wait_for_end(client, sweep);
  out.makespan_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.daemon_s = processor_time_of(daemon.number()) - used;
  add_solver_times(client, sweep, out);
  out.journal_bytes = journal_bytes_in(journal_file) - journal;
  store::Database database(journal_file);
  store::Statement events(database, "SELECT SUM(last_sequence) FROM jobs");
  if (events.step()) out.events = static_cast<double>(events.integer(0));
  for (int i = 1; i <= jobs; ++i)
    out.result_bytes +=
        static_cast<double>(std::filesystem::file_size(data / "jobs" / std::to_string(i) / "result.h5"));
  return out;
}

}  // namespace cellcrush::load
