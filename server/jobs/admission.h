#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "store/data_folder.h"

namespace cellcrush::jobs {

/// Decides whether the daemon takes new jobs. Thread-safe.
class Admission {
 public:
  struct Limits {
    std::int64_t queued_jobs = 100'000;
    std::int64_t job_memory_bytes = 0;            ///< that a job may be predicted to need; 0: what the machine has
    std::int64_t free_disk_bytes = 0;             ///< that are to be left in the data folder
    std::chrono::duration<double> job_time{0.0};  ///< of the clock that a job's workers may take; 0: no limit
  };

  /// `folder` outlives this object.
  Admission(const store::DataFolder& folder, const Limits& limits);

  /// From now on no job is taken.
  void drain() { draining_ = true; }

  /// Checks the seconds that a job asks for. Throws InvalidField.
  void check_time_limit(double seconds, const std::string& field) const;

  /// Memory of a job of which it is known that it is at most `most_bytes`: `predict` is asked only where that could be too much.
  [[nodiscard]] std::int64_t memory_of_job(std::int64_t most_bytes, const std::function<std::int64_t()>& predict) const;

  /// Whether so many more jobs, of which the largest needs so much memory, can be taken when `waiting` wait already. Throws ServiceError:
  /// unavailable while draining, exhausted beyond a limit, storage_full.
  void admit(std::size_t waiting, std::size_t count, std::int64_t memory_bytes) const;

  /// Why the disk has too little room for jobs, a sentence; nothing where it has room. Throws ServiceError.
  [[nodiscard]] std::optional<std::string> low_disk() const;

 private:
  const store::DataFolder& folder_;
  Limits limits_;
  std::atomic<bool> draining_ = false;
};

}  // namespace cellcrush::jobs
