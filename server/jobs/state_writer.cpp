#include "jobs/state_writer.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

#include "error.h"
#include "jobs/outcome.h"
#include "pause.h"
#include "store/job_state.h"
#include "store/resource_name.h"

namespace cellcrush::jobs {

v1::Job::State StateWriter::put_back(std::int64_t job, const Trouble& shortage, const std::stop_token& daemons_end) {
  do {
    try {
      return try_put_back(job, shortage, daemons_end);
    } catch (const std::exception& error) {
      const Trouble trouble = trouble_of(error);
      if (!trouble) {
        spdlog::error("{} cannot be read and is skipped until the daemon restarts: {}", store::name_of(job),
                      error.what());
        return v1::Job::JOB_STATE_UNSPECIFIED;
      }
      parts_.hold.failed(trouble);
    }
  } while (pause_unless_stopped(daemons_end, kBetweenTries));
  return v1::Job::JOB_STATE_UNSPECIFIED;
}

v1::Job::State StateWriter::try_put_back(std::int64_t job, const Trouble& shortage,
                                         const std::stop_token& daemons_end) {
  const auto stored = parts_.reader.find_job(job);
  if (!stored) return v1::Job::JOB_STATE_UNSPECIFIED;
  if (stored->job.state() != v1::Job::RUNNING) return stored->job.state();
  return write(job, waits_for(shortage), daemons_end);
}

v1::Job::State StateWriter::write(std::int64_t job, const store::StateChange& change,
                                  const std::stop_token& daemons_end) {
  // When the daemon ends, the job keeps its state, and the next daemon reconciles it.
  std::string logged;
  do {
    if (const auto written = try_write(job, change, logged)) return *written;
  } while (pause_unless_stopped(daemons_end, kBetweenTries));
  return v1::Job::JOB_STATE_UNSPECIFIED;
}

std::optional<v1::Job::State> StateWriter::try_write(std::int64_t job, const store::StateChange& change,
                                                     std::string& logged) {
  try {
    parts_.stopped(parts_.journal.change_state(job, change));
    spdlog::info("{} {}{}{}", store::name_of(job), v1::Job::State_Name(change.state),
                 change.message.empty() ? "" : ": ", change.message);
    if (change.state == v1::Job::SUCCEEDED) parts_.hold.proven();
    if (store::is_terminal(change.state)) tidy_up(job, change);
    return change.state;
  } catch (const std::exception& error) {
    const auto* refused = dynamic_cast<const ServiceError*>(&error);
    const auto kind = refused != nullptr ? refused->kind() : ServiceError::Kind::internal;
    if (kind == ServiceError::Kind::not_found) return v1::Job::JOB_STATE_UNSPECIFIED;
    // It was cancelled just after its worker had left it, or another call has changed its state.
    if (kind == ServiceError::Kind::failed_precondition)
      return store::is_terminal(change.state) ? v1::Job::JOB_STATE_UNSPECIFIED : v1::Job::CANCELLING;
    if (std::exchange(logged, error.what()) != error.what())
      spdlog::error("The state of {} cannot be saved: {}", store::name_of(job), error.what());
    if (kind == ServiceError::Kind::data_loss) return v1::Job::JOB_STATE_UNSPECIFIED;
    if (kind == ServiceError::Kind::storage_full) parts_.folder.give_up_ballast();
    if (const Trouble trouble = trouble_of(error)) parts_.hold.failed(trouble);
    return std::nullopt;
  }
}

void StateWriter::tidy_up(std::int64_t job, const store::StateChange& change) {
  parts_.metrics.count_ended(change.state, change.cause, change.summary ? &*change.summary : nullptr);
  parts_.ended(job);
  try {
    parts_.folder.clean_job_folder(job);
  } catch (const std::exception& error) {
    spdlog::warn("Leftover files of {} could not be removed; the daemon tries again at its next start: {}",
                 store::name_of(job), error.what());
  }
}

}  // namespace cellcrush::jobs
