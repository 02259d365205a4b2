#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "store/sweep_reader.h"

namespace cellcrush::jobs {

/// The jobs that wait for a slot, oldest first, and how many run of each sweep that limits that. Not thread-safe.
class WaitingJobs {
 public:
  using Membership = store::SweepReader::Membership;

  void add(std::int64_t job, const Membership& membership);

  /// Nothing happens when it does not wait.
  void remove(std::int64_t job);

  [[nodiscard]] std::size_t count() const { return waiting_.size(); }

  /// The oldest job whose sweep lets it run, which counts as running from now on. Nothing when there is none.
  struct Taken {
    std::int64_t job = 0;
    Membership membership;
  };
  std::optional<Taken> take();

  /// A job that was taken runs no more.
  void give_back(const Taken& taken);

 private:
  std::deque<Taken> waiting_;
  std::map<std::int64_t, int> running_;  ///< by sweep; only of sweeps with a limit
};

}  // namespace cellcrush::jobs
