#pragma once

#include <chrono>
#include <filesystem>
#include <memory>

#include "jobs/executor.h"
#include "jobs/local_process.h"
#include "mutex.h"
#include "slurm/attempt_folder.h"
#include "slurm/batcher.h"
#include "slurm/cluster_options.h"
#include "slurm/cluster_view.h"
#include "slurm/commands.h"
#include "translate/case_checker.h"

namespace cellcrush::slurm {

/// Computes jobs in a Slurm cluster (attempt_folder.md). A job is computed by one attempt at a time. Its files lie in a
/// folder on the shared file system and are copied into the job's folder while it runs, so a job looks the same as
/// one that runs on this machine. When the daemon ends, attempts go on; the next daemon adopts them.
class SlurmExecutor final : public jobs::Executor {
 public:
  /// `step_cost`: that of WorkerFacts. `local` makes results from reports of lost workers.
  /// REQUIRES: prepare_shared_folder.
  SlurmExecutor(ClusterOptions options, double step_cost, std::unique_ptr<jobs::LocalProcess> local);
  ~SlurmExecutor() override;
  SlurmExecutor(const SlurmExecutor&) = delete;
  SlurmExecutor& operator=(const SlurmExecutor&) = delete;

  bool has_worker(const store::JobFolder& folder) override;
  [[nodiscard]] bool keeps_workers() const override { return true; }
  std::optional<jobs::WorkerExit> read_final_report(const store::JobFolder& folder,
                                                    const jobs::WorkerEvents& events) override;
  void end_worker(const store::JobFolder& folder) override;
  jobs::WorkerExit run(const store::JobFolder& folder, const worker::Order& order, const jobs::WorkerEvents& events,
                       const jobs::Interruptions& interruptions) override;

 private:
  [[nodiscard]] AttemptFolder folder_of(const Attempt& attempt) const {
    return AttemptFolder(options_.folder, attempt.id());
  }
  std::shared_ptr<Submission> open_attempt(const store::JobFolder& folder, const worker::Order& order);
  void give_up(const store::JobFolder& folder, Submission& submission);
  /// Also sets the limit of the attempt's files.
  Need predict(const worker::Order& order, Attempt& attempt);
  /// Takes an attempt back, or asks its task to end it, and removes its files.
  void end_attempt(const store::JobFolder& folder, const Attempt& attempt);
  /// An attempt is over. Cancels its task in Slurm if that has nothing left to begin, and removes the batch's folder
  /// with the last attempt.
  void tidy_up_after(const Attempt& attempt, bool has_begun);

  ClusterOptions options_;
  double step_cost_;
  std::unique_ptr<jobs::LocalProcess> local_;
  Commands commands_;
  ClusterView view_;
  Batcher batcher_;
  Mutex checker_mutex_;
  translate::CaseChecker checker_ CELLCRUSH_GUARDED_BY(checker_mutex_);
};

}  // namespace cellcrush::slurm
