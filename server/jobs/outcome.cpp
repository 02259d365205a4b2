#include "jobs/outcome.h"

#include <csignal>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "error.h"
#include "worker/worker_main.h"

namespace cellcrush::jobs {
namespace {

// Exit codes of a shell or the loader.
constexpr int kCannotBeRun = 126;
constexpr int kCannotBeFound = 127;

store::StateChange failed(v1::Job::Cause cause, std::string message, std::string remedy) {
  store::StateChange out;
  out.state = v1::Job::FAILED;
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
  if (final.cause() != v1::Job::JOB_CAUSE_UNSPECIFIED) {
    out = failed(final.cause(), final.message(), final.remedy());
  } else {
    out.state = final.cancelled() ? v1::Job::CANCELLED : v1::Job::SUCCEEDED;
  }
  if (final.has_summary()) out.summary = final.summary();
  return out;
}

// What happened to a worker, and what to do if it keeps happening.
struct Loss {
  std::string what;
  std::string remedy = "Submit the case again. If the failure repeats, report it together with the case.";
};

Loss loss_of(const WorkerExit& exit) {
  switch (exit.kind) {
    case WorkerExit::Kind::broken: return {"The worker process sent an invalid report and was stopped."};
    case WorkerExit::Kind::stalled:
      return {"The worker process stopped responding and was stopped.",
              "Check whether the machine or its disk was stalled."};
    case WorkerExit::Kind::signalled:
      if (exit.code == SIGKILL)
        return {"The worker process was killed by " + signal_name(exit.code) + ".",
                "Check whether the machine ran out of memory, then submit the case again."};
      return {"The worker process was killed by " + signal_name(exit.code) + "."};
    case WorkerExit::Kind::gone:
      return {exit.detail.empty() ? "The worker process ended without a final report." : exit.detail};
    default: break;
  }
  if (exit.final) return {"Another program told the worker process to suspend the job."};
  return {"The worker process exited with code " + std::to_string(exit.code) + " without a final report."};
}

}  // namespace

Trouble trouble_of_exit(const WorkerExit& exit) {
  if (exit.kind == WorkerExit::Kind::not_started) {
    if (exit.trouble) return exit.trouble;
    const Shortage shortage = shortage_of_errno(exit.code);
    const bool of_machine = shortage == Shortage::memory || shortage == Shortage::descriptors;
    return {of_machine ? shortage : Shortage::worker,
            "No worker process could be started: " + std::generic_category().message(exit.code) + "."};
  }
  if (exit.final && exit.final->shortage() != 0)
    return {static_cast<Shortage>(exit.final->shortage()), exit.final->message()};
  if (exit.kind != WorkerExit::Kind::exited) return {};
  if (exit.code == kCannotBeRun || exit.code == kCannotBeFound)
    return {Shortage::worker, "The worker program could not be executed: exit code " + std::to_string(exit.code) + "."};
  if (const Shortage shortage = worker::shortage_of_exit_code(exit.code); shortage != Shortage::none)
    return {shortage, std::string("The worker process ran short of a resource: ") + name_of(shortage) + "."};
  return {};
}

store::StateChange waits_for(const Trouble& trouble) {
  store::StateChange out;
  out.state = v1::Job::PENDING;
  out.message = trouble.reason + " The job resumes from its last checkpoint once that is resolved.";
  out.remedy = remedy_for(trouble.shortage);
  return out;
}

bool needs_more_memory(const worker::Final& final) {
  return final.cause() == v1::Job::OUT_OF_MEMORY && !final.has_summary();
}

bool is_last_word(const WorkerExit& exit) {
  return exit.final && !exit.final->has_suspended_step() && !exit.final->has_begin_again() &&
         !needs_more_memory(*exit.final);
}

bool is_lost(const WorkerExit& exit) {
  if (is_last_word(exit)) return false;
  switch (exit.kind) {
    case WorkerExit::Kind::stopped:
    case WorkerExit::Kind::suspended:
    case WorkerExit::Kind::cancelled:
    case WorkerExit::Kind::left:
    case WorkerExit::Kind::displaced:
    case WorkerExit::Kind::withdrawn: return false;
    default: return true;
  }
}

store::StateChange outcome_of(const WorkerExit& exit) {
  if (is_last_word(exit)) return of_final(*exit.final);
  store::StateChange out;
  switch (exit.kind) {
    case WorkerExit::Kind::stopped:
      out.state = v1::Job::PENDING;
      out.message = exit.detail.empty() ? "The worker suspended the job at a checkpoint" : exit.detail;
      out.message += "; another worker resumes it from there.";
      return out;
    case WorkerExit::Kind::displaced:
      out.state = v1::Job::PENDING;
      out.message = exit.detail + " Another worker resumes the job from its last checkpoint.";
      return out;
    case WorkerExit::Kind::withdrawn:
      out.state = v1::Job::CANCELLED;
      out.message = exit.detail;
      return out;
    case WorkerExit::Kind::suspended:
      out.state = v1::Job::SUSPENDED;
      out.message = "The job was suspended at a checkpoint";
      if (exit.final) out.message += ", at step " + std::to_string(exit.final->suspended_step());
      out.message += ".";
      return out;
    case WorkerExit::Kind::cancelled: return cancelled_without_result();
    default: break;
  }
  if (exit.final && needs_more_memory(*exit.final)) return of_final(*exit.final);
  if (exit.out_of_memory) {
    return failed(v1::Job::OUT_OF_MEMORY,
                  exit.detail.empty() ? "The kernel killed the worker process for lack of memory." : exit.detail,
                  "Use fewer cells or elements_per_wall, run fewer jobs at once (--workers), or provide more memory.");
  }
  const Loss loss = loss_of(exit);
  return failed(v1::Job::WORKER_CRASHED, loss.what, loss.remedy);
}

store::StateChange tried_again(store::StateChange lost) {
  lost.state = v1::Job::PENDING;
  lost.cause = v1::Job::JOB_CAUSE_UNSPECIFIED;
  lost.message += " Another worker resumes the job from its last checkpoint.";
  lost.remedy.clear();
  return lost;
}

store::StateChange outcome_of(const std::exception& error) {
  const auto* refused = dynamic_cast<const ServiceError*>(&error);
  if (refused != nullptr && refused->kind() == ServiceError::Kind::data_loss)
    return failed(v1::Job::STORE_CORRUPT, error.what(), "Check the disk for faults, then submit the case again.");
  return failed(v1::Job::WORKER_CRASHED, std::string("The run could not continue: ") + error.what(),
                "Check the daemon's log, then submit the case again.");
}

store::StateChange cancelled_without_result() {
  store::StateChange out;
  out.state = v1::Job::CANCELLED;
  out.message = "The worker ended before it could write a complete result. The history is kept.";
  return out;
}

store::StateChange worker_missing() {
  return failed(v1::Job::WORKER_LOST, "The worker process ended while no daemon was running.",
                "Submit the case again.");
}

}  // namespace cellcrush::jobs
