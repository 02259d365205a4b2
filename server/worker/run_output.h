#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "store/job_folder.h"
#include "store/report_log.h"
#include "store/result_writer.h"
#include "translate/results.h"

namespace cellcrush::worker {

/// Progress and speed of a run, at most five times a second. The caller supplies the time. Not thread-safe.
class ProgressMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// `plateau_low`, `plateau_high`: strains between which the plateau stress is averaged. The run starts or resumes at
  /// `first_step`. `end_strain`: at which a run of planned steps ends; 0 if it takes exactly `step_count`.
  ProgressMeter(std::int64_t step_count, double plateau_low, double plateau_high, Clock::time_point start,
                std::int64_t first_step = 0, double end_strain = 0.0);

  void add(const v1::Sample& sample);

  /// The progress at `step`, if enough time has passed since the last one.
  std::optional<v1::Progress> read(std::int64_t step, double strain, Clock::time_point now);

 private:
  std::int64_t step_count_;
  double end_strain_;
  double plateau_low_;
  double plateau_high_;
  Clock::time_point last_time_;
  std::int64_t last_step_ = 0;
  double steps_per_second_ = 0.0;  ///< smoothed over the last few readings
  v1::Sample newest_;
  double plateau_integral_ = 0.0;  ///< impact stress over strain, within the window
  double plateau_width_ = 0.0;     ///< strain within the window so far
};

/// Sends a run's samples and frames to the reports and the result. Not thread-safe. Failures throw ServiceError.
class RunOutput {
 public:
  /// `order` outlives this object.
  RunOutput(const store::JobFolder& folder, store::ReportLog& log, const Order& order,
            std::shared_ptr<const Scene> scene);

  /// Starts with what a run had reported before it stopped at a checkpoint. False if the reports are incomplete; the
  /// object is then unusable.
  bool restore(const Checkpoint& checkpoint);

  /// Takes a sample or frame that was reported before. Repeated ones have the same bits; the first one counts.
  void take(const Report& reported);

  void put_mesh();  ///< at most once
  void put_sample(Sample sample);
  void put_frame(const FieldFrame& frame);
  /// Only if enough time has passed since the last one.
  void put_progress(std::int64_t step, double strain, ProgressMeter::Clock::time_point now);

  /// Makes the result durable and renames it. `end`: how the run ended; `device`: for ResultHeader.
  v1::Summary finish(const Final& end, const translate::RunTime& time, const std::string& device = "none");

  [[nodiscard]] int sample_count() const { return static_cast<int>(samples_.size()); }
  [[nodiscard]] std::int64_t last_sampled_step() const { return samples_.empty() ? 0 : samples_.back().step; }
  [[nodiscard]] int frame_count() const { return frame_count_; }
  [[nodiscard]] double last_frame_time() const { return last_frame_time_; }  ///< s

 private:
  [[nodiscard]] v1::Job ended_job(const Final& end, v1::Summary summary) const;
  v1::Sample record(Sample sample);
  void record(const v1::FieldFrame& frame);

  store::JobFolder folder_;
  store::ReportLog& log_;
  const Order& order_;
  std::shared_ptr<const Scene> scene_;
  SceneFacts facts_;
  v1::Mesh mesh_;  ///< empty once it was put
  ProgressMeter meter_;
  store::ResultWriter writer_;
  std::vector<Sample> samples_;
  int frame_count_ = 0;
  double last_frame_time_ = 0.0;
};

}  // namespace cellcrush::worker
