#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>

#include "jobs/local_process.h"
#include "server/held_point.h"

namespace cellcrush::testing {

/// Workers as processes, and calls to a test between what they do and what the daemon makes of it. The calls are set
/// before a job runs and come from its thread.
class HeldWorker final : public jobs::Executor {
 public:
  std::function<void(int run)> before_run = [](int) {};                 ///< the runs are counted from 0
  std::function<void(const v1::Sample&)> before_sample = [](auto&) {};  ///< it was read from the reports
  std::function<void(int run)> after_run = [](int) {};                  ///< the worker has ended

  bool has_worker(const store::JobFolder& folder) override { return workers_.has_worker(folder); }
  std::optional<jobs::WorkerExit> read_final_report(const store::JobFolder& folder,
                                                    const jobs::WorkerEvents& events) override {
    return workers_.read_final_report(folder, events);
  }
  void end_worker(const store::JobFolder& folder) override { workers_.end_worker(folder); }

  jobs::WorkerExit run(const store::JobFolder& folder, const worker::Order& order, const jobs::WorkerEvents& events,
                       const jobs::Interruptions& interruptions) override {
    const int number = runs_++;
    before_run(number);
    jobs::WorkerEvents held = events;
    held.reported = [&](worker::Report& report) {
      if (report.has_sample()) before_sample(report.sample());
      events.reported(report);
    };
    auto exit = workers_.run(folder, order, held, interruptions);
    after_run(number);
    return exit;
  }

 private:
  jobs::LocalProcess workers_{CELLCRUSHD_PROGRAM, std::chrono::seconds(20)};
  std::atomic<int> runs_ = 0;
};

}  // namespace cellcrush::testing
