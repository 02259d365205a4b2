#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace cellcrush::watch {

/// A watcher's position in the events of one job of a sweep.
struct JobPlace {
  std::int64_t job = 0;
  std::int64_t sequence = 0;  ///< of the last event sent; 0: none
  bool ended = false;         ///< its last event was sent
};

/// A watcher's positions in all jobs of a sweep, and their token. A run is a range of jobs with consecutive numbers and
/// equal positions. Most jobs of a sweep are in few runs, so that the token is short. A change takes as long in a large
/// sweep as in a small one. Not thread-safe.
class JobPlaces {
 public:
  JobPlaces() = default;
  /// REQUIRES: the jobs are in ascending order.
  explicit JobPlaces(std::vector<JobPlace> places);

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  const JobPlace& operator[](std::size_t index) const { return places_[index]; }

  void set_sequence(std::size_t index, std::int64_t sequence);
  void set_ended(std::size_t index);

  [[nodiscard]] std::size_t run_count() const { return runs_.size(); }
  /// Takes time and bytes in proportion to the runs.
  [[nodiscard]] std::string token(std::int64_t sweep) const;

 private:
  void update_runs(std::size_t index);

  std::vector<JobPlace> places_;
  std::set<std::size_t> runs_;  ///< index of the first job of each run
};

/// The positions in a token, by job. Throws ServiceError (invalid) if it is not a token of this sweep.
std::map<std::int64_t, JobPlace> parse_resume_token(std::int64_t sweep, const std::string& token);

}  // namespace cellcrush::watch
