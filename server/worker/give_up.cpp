#include "worker/give_up.h"

#include <exception>

#include "worker/checkpoint_file.h"
#include "worker/job_scene.h"
#include "worker/origin.h"
#include "worker/run_output.h"

namespace cellcrush::worker {
namespace {

// What the run took until its newest checkpoint: what came after is not known.
translate::RunTime known_time(const JobFolder& folder, const Checkpoint::Origin& origin) {
  const auto found = find_checkpoint(folder, origin);
  return found.checkpoint ? run_time_of(*found.checkpoint) : translate::RunTime{};
}

// On how many threads the newest worker ran it.
int threads_of_last_run(const JobFolder& folder) {
  ReportLogReader reader(folder.reports());
  Report report;
  int threads = 1;
  while (reader.read(report) == ReportLogReader::Read::message) {
    if (report.has_begun()) threads = report.begun().threads();
  }
  return threads;
}

}  // namespace

Final give_up(const JobFolder& folder, const Order& order, ReportLog& log, Final loss) {
  try {
    const auto origin = origin_of(order);
    // What another solver left is in a form of its own.
    if (find_other_origin(folder, origin)) return loss;
    Order as_run = order;
    as_run.set_threads(threads_of_last_run(folder));
    RunOutput output(folder, log, as_run, scene_of(order));
    output.restore_all();
    if (output.frame_count() > 0)
      *loss.mutable_summary() = output.finish(false, loss.message(), known_time(folder, origin));
  } catch (const std::exception&) {
    // Why there is no result is what the loss says already.
    loss.clear_summary();
  }
  return loss;
}

}  // namespace cellcrush::worker
