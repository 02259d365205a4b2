#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "error.h"
#include "jobs/executor.h"
#include "jobs/report_feed.h"
#include "slurm/attempt_folder.h"
#include "slurm/batcher.h"
#include "slurm/cluster_options.h"
#include "slurm/cluster_view.h"
#include "slurm/commands.h"
#include "slurm/mirror.h"

namespace cellcrush::slurm {

/// Follows one attempt from its submission to its end, and decides what became of it. What counts, in this order: the
/// last word of its task, the task's heartbeat, sacct, squeue. That something is missing proves nothing: before an
/// attempt is given to another task, the daemon takes it back by its claim, or its task has ended or lost its lease.
/// Not thread-safe.
class AttemptFollower {
 public:
  /// All outlive it.
  struct Parts {
    const ClusterOptions& options;
    const Commands& commands;
    ClusterView& view;
    const jobs::WorkerEvents& events;
    const jobs::Interruptions& interruptions;
    /// Called once the attempt is over, with whether a task had begun it.
    const std::function<void(const Attempt&, bool has_begun)>& closed;
  };
  AttemptFollower(const Parts& parts, const store::JobFolder& job, std::shared_ptr<Submission> submission);

  /// Returns when the attempt is over, or left to the next daemon. An exception from `events` propagates.
  jobs::WorkerExit follow();

 private:
  using Clock = std::chrono::steady_clock;

  /// One look at the attempt; its end, if it is over.
  std::optional<jobs::WorkerExit> look();
  /// What the view knows of the attempt's task.
  [[nodiscard]] std::optional<ClusterView::Seen> seen_task(const Attempt& attempt);
  std::optional<jobs::WorkerExit> look_at_waiting();
  std::optional<jobs::WorkerExit> look_at_begun();
  std::optional<jobs::WorkerExit> forward_requests();
  /// Reads what the attempt's folder says, and copies new files. Returns whether all of that was possible.
  bool read_folder();
  /// Logs what is tried again, once.
  void note_trouble(const ServiceError& error);
  /// Whether everything is here that the last word says.
  [[nodiscard]] bool is_complete(const Ended& ended) const;
  /// The final report of the attempt's worker, which an earlier follower may have copied.
  [[nodiscard]] std::optional<worker::Final> final_report() const;
  /// Asks Slurm for news of the task, not more often than this.
  void ask_slurm(std::chrono::milliseconds interval);
  std::optional<jobs::WorkerExit> exit_of_ended(const Ended& ended);
  std::optional<jobs::WorkerExit> exit_of_incomplete();
  void show_place();
  void wait();

  /// Takes the attempt back before a task has begun it. False if one has.
  bool withdraw();
  /// The attempt is over: nothing of it counts from now on.
  void close(bool ends_task);
  void look_for_number();
  std::optional<jobs::WorkerExit> not_submitted(const Submission::State& state);
  /// A task that is over without a last word.
  std::optional<jobs::WorkerExit> exit_of_silent(const Submission::State& state);
  /// What the task's log ends with, as a sentence; empty if it says nothing.
  [[nodiscard]] std::string last_line_of_log(const Attempt& attempt) const;

  Parts parts_;
  store::JobFolder job_;
  std::shared_ptr<Submission> submission_;
  AttemptFolder folder_;
  Mirror mirror_;
  jobs::ReportFeed feed_;
  std::optional<worker::Final> final_before_;  ///< that was in the job's folder when this follower began
  std::optional<Ended> last_word_;
  std::optional<Claim> claim_;
  bool has_begun_ = false;
  std::optional<std::uint64_t> beat_;
  std::optional<Clock::time_point> asked_slurm_;
  std::optional<Clock::time_point> ended_;      ///< when its last word was read
  Clock::time_point last_sign_ = Clock::now();  ///< of life
  Clock::time_point last_look_ = Clock::now();
  Clock::time_point opened_ = Clock::now();
  std::optional<std::uint64_t> answers_when_lost_;    ///< number of answers when the answer of sbatch was missed
  std::optional<std::uint64_t> answers_when_missed_;  ///< number of answers when the task was first missed
  std::optional<Clock::time_point> asked_;            ///< when the task was asked to leave or end the job
  Request::Kind request_ = Request::NONE;
  std::uint64_t unlisted_since_ = 0;  ///< number of the answer after which a task that is not listed is missed
  std::string place_;
  std::string trouble_;    ///< the last that was logged
  std::string too_large_;  ///< which file of the attempt's exceeds its limit
  std::mutex wake_mutex_;
  std::condition_variable wake_;
  bool is_woken_ = false;
};

}  // namespace cellcrush::slurm
