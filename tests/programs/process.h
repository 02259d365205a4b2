#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace cellcrush::e2e {

/// How a program ended.
struct Outcome {
  int exit_code = -1;  ///< 128 + signal when a signal ended it; -1 when it was ended here because its time was up
  bool timed_out = false;
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
  double seconds = 0.0;

  /// Everything it said.
  [[nodiscard]] std::string all() const { return output + errors; }
};

/// A program that runs beside the test, in a process group of its own. It is killed when the object or the test's
/// process ends. Not thread-safe.
class Process {
 public:
  /// Starts `command[0]` with `input` as its standard input, or on a terminal of so many columns, whose output is all
  /// in output(). Throws std::system_error when it cannot be started.
  explicit Process(const std::vector<std::string>& command, const std::string& input = {}, int columns = 0);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Reads until `text` stands in the output. False when the program ended or the time was up before.
  bool wait_for_output(const std::string& text, std::chrono::milliseconds limit);
  /// The same for a condition on what was read.
  bool read_until(const std::function<bool()>& condition, std::chrono::milliseconds limit);

  /// Reads until the program has ended; kills it when the time is up. REQUIRES: not called before.
  Outcome wait(std::chrono::milliseconds limit);

  void send(int signal) const;
  /// Types `text` on its terminal.
  void type(const std::string& text) const;
  /// -1 when it has ended and was waited for.
  [[nodiscard]] int id() const { return id_; }
  [[nodiscard]] const std::string& output() const { return output_; }
  [[nodiscard]] const std::string& errors() const { return errors_; }

 private:
  bool read_some(std::chrono::steady_clock::time_point deadline);

  int id_ = -1;
  int output_pipe_ = -1;
  int error_pipe_ = -1;
  std::string output_;
  std::string errors_;
  std::chrono::steady_clock::time_point start_;
};

/// Runs a program to its end.
Outcome run(const std::vector<std::string>& command, std::chrono::milliseconds limit);

}  // namespace cellcrush::e2e
namespace cellcrush::testing {

/// Looks every 20 ms; false when the condition does not hold within this time.
template <class Condition>
bool wait_until(const Condition& condition, std::chrono::milliseconds limit = std::chrono::seconds(20)) {
  for (const auto end = std::chrono::steady_clock::now() + limit; !condition();) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace cellcrush::testing
