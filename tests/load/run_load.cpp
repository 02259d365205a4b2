// Runs small jobs on a daemon of this machine and prints what they took.
// usage: run_load [JOBS [WORKERS]]
#include <fmt/core.h>

#include <cstdlib>
#include <exception>

#include "load/job_runs.h"
#include "server/small_case.h"
#include "server/temporary_folder.h"

int main(int count, char** words) {
  const int jobs = count > 1 ? std::atoi(words[1]) : 1000;
  const int workers = count > 2 ? std::atoi(words[2]) : 2;
  const cellcrush::testing::TemporaryFolder folder;
  try {
    const auto runs = cellcrush::load::run_jobs(folder.path(), cellcrush::testing::small_case(), jobs, workers);
    fmt::print("what,measured\nmakespan_s,{:.1f}\ndaemon_cpu_s,{:.2f}\njournal_mb,{:.3f}\nresults_mb,{:.3f}\n",
               runs.makespan_s, runs.daemon_s, 1e-6 * runs.journal_bytes, 1e-6 * runs.result_bytes);
    fmt::print("events_per_s,{:.1f}\nsolver_s,{:.4f}\n", runs.events / runs.makespan_s, runs.solver_s);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
