#pragma once

#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/daemon_fixture.h"

namespace cellcrush::load {

/// Calls a daemon every few milliseconds, to show what other callers wait while something large happens: one thread
/// reads a job, another repeats a submit with its request id, which takes the journal's turn and changes nothing.
class CallProbe {
 public:
  /// `job`: name of a job that exists.
  CallProbe(const std::string& address, const std::string& job);

  /// Prints the times since the start or the last call of it.
  void print(const std::string& during);

 private:
  void call(const std::stop_token& stop, std::vector<double>& seconds, const std::function<void()>& once);

  testing::Client reading_;
  testing::Client writing_;
  std::mutex mutex_;
  std::vector<double> reads_;
  std::vector<double> writes_;
  std::jthread reader_;
  std::jthread writer_;
};

}  // namespace cellcrush::load
