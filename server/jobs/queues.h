#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/queue_hold.h"
#include "jobs/scheduler.h"

namespace cellcrush::jobs {

/// Throws ServiceError (invalid) if two executors have the same name or none has the default one.
void check_executors(const std::vector<std::string>& names, const std::string& default_name);

/// The queues of all executors, and the jobs that they run. Each executor has a queue, a hold and slots of its own, so
/// that trouble on one holds up no job of another. Calls about a job go to the queue of its executor. Also keeps the
/// jobs of executors that the daemon lacks: they can be cancelled and none starts. Thread-safe.
class Queues {
 public:
  /// One queue as it is now.
  struct Standing {
    std::string executor;
    int slots = 0;
    bool is_present = true;   ///< whether the daemon has the executor
    std::vector<Hold> holds;  ///< what holds the queue
  };

  /// Dependencies, which outlive the queues, and what all of them share.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    watch::Hub& hub;
    metrics::Metrics& metrics;
    /// Called after each change of what holds the queues. Must not call back.
    std::function<void(const std::vector<Standing>&)> told;
    HoldTimes hold_times;
    std::chrono::milliseconds checkpoint_interval;
    double longest_job_s;            ///< wall-clock limit of a job; 0: none
    std::int64_t most_memory_bytes;  ///< a raised limit of a job's memory does not exceed it; 0: none
    int owner_max_running;           ///< jobs of one owner that run at once on one executor; 0: no limit
    std::string default_name;        ///< executor of requests that name none
    double step_cost = 0.0;          ///< of WorkerFacts
  };

  struct NamedExecutor {
    std::string name;
    int slots = 1;  ///< jobs that it has at once
    std::unique_ptr<Executor> executor;
  };

  /// `executors`: that of this machine, then the others. Throws ServiceError (invalid) if two have the same name or
  /// none has the default one.
  Queues(const Parts& parts, std::vector<NamedExecutor> executors);
  ~Queues();
  Queues(const Queues&) = delete;
  Queues& operator=(const Queues&) = delete;

  /// Cleans up after an earlier daemon, takes over its jobs, and starts the slots of all executors.
  void start();

  /// Name of the requested executor; the default one if it is empty. Throws InvalidField for one that the daemon lacks.
  [[nodiscard]] std::string executor_for(const std::string& requested, const std::string& field) const;

  /// Throws ServiceError (failed_precondition) if the daemon lacks it.
  void require(const std::string& executor) const;

  [[nodiscard]] const std::string& default_name() const { return parts_.default_name; }

  /// All queues: that of this machine, those of the others, those of executors that the daemon lacks.
  [[nodiscard]] std::vector<Standing> standings() const;

  /// These are as in Scheduler, for jobs of any executor.
  void enqueue(const std::vector<store::QueuedJob>& jobs);
  void cancel(std::int64_t job);
  void suspend(std::int64_t job, const std::function<bool()>& given_up);
  void resume(std::int64_t job);
  void hold_for_low_disk(const std::optional<std::string>& reason);
  [[nodiscard]] std::size_t waiting_count();
  [[nodiscard]] std::size_t waiting_count(const std::string& owner);
  [[nodiscard]] Load load();
  [[nodiscard]] int cores_of(const store::QueuedJob& job);
  void stop();

  /// Cancels the unfinished ones among the jobs. Waiting jobs leave their queues at once.
  void cancel_all(const std::vector<std::int64_t>& jobs);

  /// QueueHold::try_now of all queues.
  void try_now(Shortage shortage);

 private:
  struct Queue;

  /// Cancels the waiting ones among the jobs.
  void cancel_waiting(const std::vector<std::int64_t>& jobs);
  /// Sets aside (DataFolder::set_aside) entries of jobs/ that belong to no job, and unusable folders of open jobs,
  /// whose workers end first. The log names each one, also those that cannot be moved and stay.
  void audit_folders();
  void set_aside(const std::string& name, const std::string& why) const;
  void clean_up();
  bool end_worker(const store::QueuedJob& job);
  /// Queues jobs of an executor that the daemon lacks.
  void keep(Queue& queue);
  /// Null if the daemon lacks it and no unfinished job is for it.
  [[nodiscard]] Queue* find(const std::string& executor) const;
  /// That of the job's executor; any for a job that has ended. Throws ServiceError (not_found).
  Queue& queue_of(std::int64_t job);
  void end_cancelled(std::int64_t job, const std::string& executor);
  [[nodiscard]] std::string names() const;
  void tell();

  Parts parts_;
  Mutex telling_;
  std::vector<std::unique_ptr<Queue>> queues_;  ///< constant from construction on
};

}  // namespace cellcrush::jobs
