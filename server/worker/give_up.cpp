#include "worker/give_up.h"

#include <exception>
#include <utility>

#include "shortage.h"
#include "worker/checkpoint_file.h"
#include "worker/run_output.h"

namespace cellcrush::worker {
namespace {

// Time of the run up to its newest checkpoint; the time after it is unknown.
translate::RunTime known_time(const store::JobFolder& folder, const Checkpoint::Origin& origin) {
  const auto found = find_checkpoint(folder, origin);
  return found.checkpoint ? run_time_of(*found.checkpoint) : translate::RunTime{};
}

// Whether it was asked to leave the job; acknowledges a cancel once.
bool must_leave(const RequestedStop& requested_stop, store::ReportLog& log, bool& acknowledged) {
  const StopRequest request = requested_stop();
  if (request == StopRequest::cancel && !std::exchange(acknowledged, true)) {
    Report report;
    report.mutable_stopping();
    log.append(report);
  }
  return request == StopRequest::suspend;
}

}  // namespace

Final give_up(const store::JobFolder& folder, const Order& order, store::ReportLog& log,
              const RequestedStop& requested_stop, Final loss) {
  try {
    const auto origin = origin_of(order);
    Order as_run = order;
    bool acknowledged = false;
    // Before building the scene, which may take longer than the daemon waits for a report.
    static_cast<void>(must_leave(requested_stop, log, acknowledged));
    RunOutput output(folder, log, as_run, scene_of(order));
    store::ReportLogReader reader(folder.reports());
    Report report;
    while (reader.read(report) == store::ReportLogReader::Read::message) {
      if (must_leave(requested_stop, log, acknowledged)) {
        Final left;
        left.set_suspended_step(output.last_sampled_step());
        return left;
      }
      if (report.has_begun()) {
        // The files of another solver have a different form.
        if (report.begun().origin().SerializeAsString() != origin.SerializeAsString()) return loss;
        as_run.set_threads(report.begun().threads());
      }
      output.take(report);
    }
    if (output.frame_count() > 0) *loss.mutable_summary() = output.finish(loss, known_time(folder, origin));
  } catch (const std::exception& error) {
    const Trouble trouble = trouble_of(error);
    if (trouble.shortage != Shortage::none && trouble.shortage != Shortage::memory && !loss.cancelled()) {
      Final left;
      left.set_suspended_step(0);
      left.set_shortage(static_cast<int>(trouble.shortage));
      left.set_message(trouble.reason);
      return left;
    }
    // The loss already says why there is no result.
    loss.clear_summary();
  }
  return loss;
}

}  // namespace cellcrush::worker
