#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "cellcrush/v1/case.pb.h"
#include "jobs/executor.h"

namespace cellcrush::testing {

/// An order to compute the case with one thread.
worker::Order order_of(const v1::Case& submitted);

/// One run of a job by an executor, on a thread of its own, as the daemon makes it.
class ExecutorRun {
 public:
  /// `executor` outlives it.
  ExecutorRun(jobs::Executor& executor, const store::JobFolder& folder, const worker::Order& order);
  ~ExecutorRun();
  ExecutorRun(const ExecutorRun&) = delete;
  ExecutorRun& operator=(const ExecutorRun&) = delete;

  void suspend() { suspend_.request_stop(); }
  void cancel() { cancel_.request_stop(); }
  /// As when the daemon ends.
  void leave() { stop_.request_stop(); }

  /// Waits for the first worker; its process on the node, or 0 after the limit.
  int wait_for_start(std::chrono::milliseconds limit = std::chrono::seconds(60));
  /// Waits until so many samples were reported; whether they were.
  bool wait_for_samples(std::size_t count, std::chrono::milliseconds limit = std::chrono::seconds(60));
  /// Waits until the place contains the text; the last place.
  std::string wait_for_place(const std::string& text, std::chrono::milliseconds limit = std::chrono::seconds(60));

  /// Waits for the end, without a limit: ctest has one. Throws what `run` threw.
  jobs::WorkerExit wait();
  [[nodiscard]] bool has_ended();

  /// The samples reported so far, as bytes. A resumed run repeats some.
  [[nodiscard]] std::vector<std::string> samples();
  /// The steps at which workers began.
  [[nodiscard]] std::vector<std::int64_t> begun_steps();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int started_ = 0;
  std::vector<std::string> samples_;
  std::vector<std::int64_t> begun_steps_;
  std::string place_;
  bool ended_ = false;
  jobs::WorkerExit exit_;
  std::exception_ptr error_;
  std::stop_source stop_;
  std::stop_source suspend_;
  std::stop_source cancel_;
  std::thread thread_;
};

}  // namespace cellcrush::testing
