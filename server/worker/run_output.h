#pragma once

#include <cstdint>
#include <vector>

#include "cellcrush/simulation.h"
#include "store/result_writer.h"
#include "worker/job_folder.h"
#include "worker/progress_meter.h"
#include "worker/report_log.h"

namespace cellcrush::worker {

/// Where a run's samples and frames go: to the reports and to the result. Not thread-safe. Failures throw ServiceError.
class RunOutput {
 public:
  RunOutput(const JobFolder& folder, ReportLog& log, const v1::Case& submitted, const Scene& scene);

  /// Begins with what a run had given when it was left at a checkpoint: its samples, and its first `frame_count` frames, which
  /// are taken from the reports. False when these do not hold them all; this object is of no use then.
  bool restore(std::vector<Sample> samples, int frame_count, std::int64_t step);

  void put_mesh();
  void put_sample(Sample sample);
  void put_frame(const FieldFrame& frame);
  /// Where enough time has gone by since the last one.
  void put_progress(std::int64_t step, double strain, ProgressMeter::Clock::time_point now);

  /// Makes the result durable and gives it its name.
  void finish(const store::ResultHeader& header, const v1::Summary& summary);

  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }
  [[nodiscard]] int frame_count() const { return frame_count_; }
  [[nodiscard]] double last_frame_time() const { return last_frame_time_; }  ///< s

 private:
  v1::Sample record(Sample sample);
  void record(const v1::FieldFrame& frame);

  JobFolder folder_;
  ReportLog& log_;
  const v1::Case& case_;
  SceneFacts facts_;
  v1::Mesh mesh_;
  ProgressMeter meter_;
  store::ResultWriter writer_;
  std::vector<Sample> samples_;
  int frame_count_ = 0;
  double last_frame_time_ = 0.0;
};

}  // namespace cellcrush::worker
