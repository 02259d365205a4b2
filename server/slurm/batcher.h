#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "mutex.h"
#include "shortage.h"
#include "slurm/attempt.pb.h"
#include "slurm/cluster_options.h"
#include "slurm/commands.h"
#include "store/job_folder.h"

namespace cellcrush::slurm {

/// What an attempt needs of a node, as predicted.
struct Need {
  int threads = 1;
  std::int64_t memory_mib = 0;
  double seconds = 0.0;  ///< of wall-clock time

  bool operator==(const Need&) const = default;
};

/// What sbatch asks for on behalf of an attempt whose worker may use `raised` times the memory of a first attempt
/// (translate/worker_memory.h). Memory in steps, so that attempts of one sweep share an array; the first request is
/// rounded before it is raised, so that the next one is larger.
Need need_of(int threads, std::int64_t first_bytes, double raised, double seconds);

/// Attempts, by index, that one task computes one after the other.
using Share = std::vector<std::size_t>;

/// Attempts that one sbatch submits: all tasks ask for the same threads and memory.
struct Pack {
  Need need;  ///< seconds: of the longest task
  std::vector<Share> tasks;
};

/// Distributes attempts over tasks, in their order. A task takes further attempts until it is predicted to run for
/// `task_length`: Slurm itself needs about half a second a task. At most `most_tasks` tasks a pack.
std::vector<Pack> pack(const std::vector<Need>& attempts, std::chrono::duration<double> task_length,
                       std::size_t most_tasks);

/// Time limit to ask for, in minutes: three times the prediction and ten minutes, at most `longest` unless that is 0.
std::int64_t time_limit_minutes(double seconds, std::chrono::seconds longest);

/// The way of one attempt into Slurm. Thread-safe.
class Submission {
 public:
  enum class Stage {
    gathered,  ///< waits for others to share an sbatch with
    taken,     ///< sbatch runs, or is about to
    answered,  ///< it has a job number
    refused,   ///< Slurm did not take it
    lost,      ///< sbatch gave no answer: Slurm may have taken it
  };
  struct State {
    Stage stage = Stage::gathered;
    Attempt attempt;
    std::string why;  ///< it was refused or lost
    Trouble trouble;  ///< the shortage for which it was refused, if it was one of this daemon
  };
  explicit Submission(Attempt attempt, Stage stage = Stage::gathered) : state_{stage, std::move(attempt), {}, {}} {}

  [[nodiscard]] State state();
  /// Writes the attempt into the job's folder and sets the state, unless the attempt is over. Returns whether it did.
  bool keep(const store::JobFolder& job, State state);
  /// The attempt is over: removes it from the job's folder.
  void close(const store::JobFolder& job);
  /// Withdraws it unless it was taken. Returns whether it did.
  bool withdraw();
  /// Takes it for an sbatch. False if it was withdrawn.
  bool take();

 private:
  Mutex mutex_;
  State state_ CELLCRUSH_GUARDED_BY(mutex_);
  bool is_withdrawn_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  bool is_closed_ CELLCRUSH_GUARDED_BY(mutex_) = false;
};

/// Submits attempts to a cluster. Attempts that arrive together share an sbatch as an array, and short ones a task.
/// What sbatch is about to submit is durable before it runs. Thread-safe.
class Batcher {
 public:
  /// All outlive it.
  Batcher(const ClusterOptions& options, const Commands& commands);

  /// `job` has the attempt's file, which is written before and after sbatch runs.
  std::shared_ptr<Submission> submit(Attempt attempt, const store::JobFolder& job, const Need& need);

  [[nodiscard]] static std::filesystem::path batch_folder(const ClusterOptions& options, const std::string& batch);

 private:
  struct Gathered {
    std::shared_ptr<Submission> submission;
    store::JobFolder job;
    Need need;
  };
  void run(const std::stop_token& stop);
  void submit_pack(Pack pack, const std::vector<Gathered>& gathered);
  void tell(const Gathered& gathered, Submission::State state);
  [[nodiscard]] std::string script_of(const std::string& batch) const;
  /// Writes the batch's folder. Returns the arguments of sbatch.
  std::vector<std::string> prepare(const std::string& batch, const Pack& pack, const std::vector<Gathered>& gathered);

  const ClusterOptions& options_;
  const Commands& commands_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<Gathered> gathered_ CELLCRUSH_GUARDED_BY(mutex_);
  std::jthread thread_;
};

/// Index of an attempt's task for scancel and in the cluster's view: -1 unless its job is an array.
int task_index(const Attempt& attempt);

}  // namespace cellcrush::slurm
