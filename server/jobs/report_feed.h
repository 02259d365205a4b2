#pragma once

#include <optional>

#include "jobs/executor.h"
#include "store/report_log.h"

namespace cellcrush::jobs {

/// Delivers the reports of a job's folder as they appear, from the first one on. Not thread-safe. Failures throw
/// ServiceError.
class ReportFeed {
 public:
  ReportFeed(const store::JobFolder& folder, const WorkerEvents& events);

  enum class Reading { nothing_new, something_new, broken };
  /// Delivers what is new. A worker that has ended (`live` is false) makes no progress.
  Reading read(bool live);

  /// The final report, if the last worker made one.
  [[nodiscard]] const std::optional<worker::Final>& last_word() const { return final_; }
  /// A worker is about to start.
  void forget_last_word() { final_.reset(); }

  /// Whether the worker acknowledged a request to cancel since the last call.
  bool take_acknowledgement();

  /// Reports that the worker stalls, unless that was the newest report.
  void report_stall();

 private:
  const WorkerEvents& events_;
  store::ReportLogReader reader_;
  worker::Report report_;  ///< the current report; its memory is reused
  std::optional<worker::Final> final_;
  v1::Progress progress_;  ///< the newest
  bool acknowledged_ = false;
};

}  // namespace cellcrush::jobs
