#include "jobs/outcome.h"

#include <csignal>
#include <cstring>
#include <string>
#include <utility>

#include "error.h"

namespace cellcrush::jobs {
namespace {

store::StateChange failed(v1::JobCause cause, std::string message, std::string remedy) {
  store::StateChange out;
  out.state = v1::FAILED;
  out.cause = cause;
  out.message = std::move(message);
  out.remedy = std::move(remedy);
  return out;
}

// "SIGSEGV (11)".
std::string signal_name(int number) {
  const char* abbreviation = sigabbrev_np(number);
  const std::string name = abbreviation != nullptr ? std::string("SIG") + abbreviation : "an unnamed signal";
  return name + " (" + std::to_string(number) + ")";
}

store::StateChange of_final(const worker::Final& final) {
  store::StateChange out;
  if (final.cause() != v1::JOB_CAUSE_UNSPECIFIED) {
    out = failed(final.cause(), final.message(), final.remedy());
  } else {
    out.state = final.cancelled() ? v1::CANCELLED : v1::SUCCEEDED;
  }
  if (final.has_summary()) out.summary = final.summary();
  return out;
}

}  // namespace

store::StateChange outcome_of(const WorkerExit& exit) {
  if (exit.final) return of_final(*exit.final);
  const std::string again = "Submit the case again; if it happens again, report the case.";
  switch (exit.kind) {
    case WorkerExit::Kind::stopped: return worker_lost();
    case WorkerExit::Kind::cancelled: return cancelled_without_result();
    case WorkerExit::Kind::not_started:
      return failed(v1::WORKER_CRASHED, "No worker process could be started: " + exit.reason + ".",
                    "Look into the limits on processes and memory, then submit the case again.");
    case WorkerExit::Kind::broken:
      return failed(v1::WORKER_CRASHED, "The worker process sent what is no report, and was ended.", again);
    case WorkerExit::Kind::signalled:
      return failed(
          v1::WORKER_CRASHED, "The worker process was ended by " + signal_name(exit.code) + ".",
          exit.code == SIGKILL ? "Look whether the machine ran out of memory, then submit the case again." : again);
    case WorkerExit::Kind::exited: break;
  }
  return failed(v1::WORKER_CRASHED,
                "The worker process ended with exit code " + std::to_string(exit.code) + " and without a final report.",
                again);
}

store::StateChange outcome_of(const std::exception& error) {
  const auto* refused = dynamic_cast<const ServiceError*>(&error);
  if (refused != nullptr && refused->kind() == ServiceError::Kind::storage_full)
    return failed(v1::DISK_FULL, error.what(), "Make room in the data folder and submit the case again.");
  return failed(v1::WORKER_CRASHED, std::string("The run could not be kept up: ") + error.what(),
                "Look into the daemon's log, then submit the case again.");
}

store::StateChange cancelled_without_result() {
  store::StateChange out;
  out.state = v1::CANCELLED;
  out.message = "The worker ended before it could close a result. The history is kept.";
  return out;
}

store::StateChange worker_lost() {
  return failed(v1::WORKER_LOST, "The daemon ended while the job ran, and the worker with it.",
                "Submit the case again.");
}

}  // namespace cellcrush::jobs
