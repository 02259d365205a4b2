#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>

#include "jobs/deletion.h"

namespace cellcrush::jobs {

/// Deletes what ended long ago, or what is too much, the oldest end first. A sweep is kept or deleted whole: it ends
/// with the last of its jobs. Ages are counted by the service clock (store/service_clock.h), so that neither a wall
/// clock that is set wrong nor the time in which no daemon ran makes anything old. Not thread-safe.
class Retention {
 public:
  /// Each 0: no limit.
  struct Limits {
    std::chrono::seconds age{0};  ///< since the end
    std::int64_t count = 0;       ///< jobs that have ended
    std::int64_t bytes = 0;       ///< of their results and their rows in the journal
  };

  /// `parts` and `deletion` outlive this object.
  Retention(const Deletion::Parts& parts, const Deletion& deletion, const Limits& limits)
      : parts_(parts), deletion_(deletion), limits_(limits) {}

  /// Notes what jobs take that ended since, some at a time.
  void measure() const;

  /// Deletes what is beyond a limit, about a thousand jobs at most. Ends early once `given_up` says so.
  void enforce(const std::function<bool()>& given_up);

 private:
  [[nodiscard]] bool has_limit() const { return limits_.age.count() > 0 || limits_.count > 0 || limits_.bytes > 0; }
  [[nodiscard]] bool is_too_much(const store::EndedTotals& totals) const;
  [[nodiscard]] bool is_old(std::int64_t ended_at) const;
  /// The end of a job's sweep, which is looked up once a walk.
  const store::SweepEnd& end_of(std::int64_t sweep);
  void delete_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const;

  Deletion::Parts parts_;
  const Deletion& deletion_;
  Limits limits_;
  std::map<std::int64_t, store::SweepEnd> sweeps_;  ///< seen in this walk
};

}  // namespace cellcrush::jobs
