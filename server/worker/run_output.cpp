#include "worker/run_output.h"

#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cellcrush/sample.h"
#include "cellcrush/simd.h"
#include "revision.h"
#include "store/durable_file.h"
#include "translate/case_to_spec.h"
#include "translate/case_words.h"

namespace cellcrush::worker {
namespace {

constexpr std::chrono::milliseconds kInterval{200};
constexpr double kNewShare = 0.3;  // weight of the newest reading of the speed

ProgressMeter meter_of(const SceneFacts& facts, std::int64_t first_step) {
  return {facts.step_count, Summary::kPlateauLow, Summary::kPlateauHigh, ProgressMeter::Clock::now(),
          first_step,       facts.end_strain};
}

}  // namespace

ProgressMeter::ProgressMeter(std::int64_t step_count, double plateau_low, double plateau_high, Clock::time_point start,
                             std::int64_t first_step, double end_strain)
    : step_count_(step_count),
      end_strain_(end_strain),
      plateau_low_(plateau_low),
      plateau_high_(plateau_high),
      last_time_(start),
      last_step_(first_step) {}

void ProgressMeter::add(const v1::Sample& sample) {
  // A sample's stress is the mean since the sample before it.
  const double from = std::clamp(newest_.strain(), plateau_low_, plateau_high_);
  const double to = std::clamp(sample.strain(), plateau_low_, plateau_high_);
  plateau_integral_ += sample.stress_impact_mpa() * (to - from);
  plateau_width_ += to - from;
  newest_ = sample;
}

std::optional<v1::Progress> ProgressMeter::read(std::int64_t step, double strain, Clock::time_point now) {
  if (now - last_time_ < kInterval) return std::nullopt;
  const double seconds = std::chrono::duration<double>(now - last_time_).count();
  const double speed = static_cast<double>(step - last_step_) / seconds;
  steps_per_second_ = steps_per_second_ > 0.0 ? (1.0 - kNewShare) * steps_per_second_ + kNewShare * speed : speed;
  last_time_ = now;
  last_step_ = step;
  const auto at_this_pace = static_cast<std::int64_t>(static_cast<double>(step) * end_strain_ / std::max(strain, 1e-9));
  const std::int64_t step_count = 2 * step > step_count_ ? std::max(step_count_, at_this_pace) : step_count_;

  v1::Progress out;
  out.set_strain(strain);
  out.set_step(step);
  out.set_step_count(step_count);
  out.set_steps_per_second(steps_per_second_);
  if (steps_per_second_ > 0.0) out.set_seconds_left(static_cast<double>(step_count - step) / steps_per_second_);
  if (plateau_width_ > 0.0) out.set_plateau_so_far_mpa(plateau_integral_ / plateau_width_);
  if (step_count > 0) out.set_fraction(static_cast<double>(step) / static_cast<double>(step_count));
  out.set_stress_impact_mpa(newest_.stress_impact_mpa());
  out.set_stress_support_mpa(newest_.stress_support_mpa());
  return out;
}

RunOutput::RunOutput(const store::JobFolder& folder, store::ReportLog& log, const Order& order,
                     std::shared_ptr<const Scene> scene)
    : folder_(folder),
      log_(log),
      order_(order),
      scene_(std::move(scene)),
      facts_(facts_of(*scene_)),
      mesh_(translate::to_proto(mesh_of(*scene_))),
      meter_(meter_of(facts_, 0)),
      writer_(folder.partial_result(), mesh_) {}

bool RunOutput::restore(const Checkpoint& checkpoint) {
  meter_ = meter_of(facts_, checkpoint.step());
  store::ReportLogReader reader(folder_.reports());
  Report report;
  while ((sample_count() < checkpoint.sample_count() || frame_count_ < checkpoint.frame_count()) &&
         reader.read(report) == store::ReportLogReader::Read::message) {
    const bool is_wanted =
        report.has_sample() ? sample_count() < checkpoint.sample_count() : frame_count_ < checkpoint.frame_count();
    if (is_wanted) take(report);
  }
  return sample_count() == checkpoint.sample_count() && frame_count_ == checkpoint.frame_count();
}

void RunOutput::take(const Report& reported) {
  if (reported.has_sample()) {
    const bool is_new = samples_.empty() || reported.sample().step() > samples_.back().step;
    auto bits = is_new ? samples_of(reported.sample_bits()) : std::nullopt;
    if (bits && bits->size() == 1) record(std::move(bits->front()));
  } else if (reported.has_frame() && reported.frame().index() == frame_count_) {
    record(reported.frame());
  }
}

void RunOutput::put_mesh() {
  Report report;
  *report.mutable_mesh() = std::move(mesh_);
  log_.append(report);
}

void RunOutput::put_sample(Sample sample) {
  Report report;
  report.set_sample_bits(bytes_of({&sample, 1}));
  *report.mutable_sample() = record(std::move(sample));
  log_.append(report);
}

v1::Sample RunOutput::record(Sample sample) {
  auto out = translate::to_proto(sample, order_.case_());
  samples_.push_back(std::move(sample));
  meter_.add(out);
  writer_.add_sample(out);
  return out;
}

void RunOutput::put_frame(const FieldFrame& frame) {
  Report report;
  *report.mutable_frame() = translate::to_proto(frame);
  record(report.frame());
  log_.append(report);
}

void RunOutput::record(const v1::FieldFrame& frame) {
  last_frame_time_ = frame.time_s();
  ++frame_count_;
  writer_.add_frame(frame);
}

void RunOutput::put_progress(std::int64_t step, double strain, ProgressMeter::Clock::time_point now) {
  if (auto progress = meter_.read(step, strain, now)) {
    Report report;
    *report.mutable_progress() = *std::move(progress);
    log_.append(report);
  }
}

// As GetJob will return it, but for the time of the end, which the daemon notes a moment later.
v1::Job RunOutput::ended_job(const Final& end, v1::Summary summary) const {
  v1::Job out = order_.described_job();
  *out.mutable_case_() = order_.case_();
  *out.mutable_summary() = std::move(summary);
  *out.mutable_end_time() = google::protobuf::util::TimeUtil::GetCurrentTime();
  const bool has_failed = end.cause() != v1::Job::JOB_CAUSE_UNSPECIFIED;
  out.set_state(has_failed ? v1::Job::FAILED : end.cancelled() ? v1::Job::CANCELLED : v1::Job::SUCCEEDED);
  out.set_cause(end.cause());
  out.set_cause_message(end.message());
  out.set_remedy(end.remedy());
  translate::add_words(out);
  return out;
}

v1::Summary RunOutput::finish(const Final& end, const translate::RunTime& time, const std::string& device) {
  auto summary = translate::to_proto(summarize(*scene_, samples_), samples_.empty() ? Sample{} : samples_.back(), time,
                                     order_.case_());
  translate::add_moduli(translate::to_spec(order_.case_()).spec, *summary.mutable_theory());
  if (end.cancelled() || end.cause() != v1::Job::JOB_CAUSE_UNSPECIFIED) summary.clear_end();
  writer_.finish({ended_job(end, summary), kSolverRevision, simd_target(), order_.threads(), facts_.time_step,
                  facts_.modelled, kCitation, device});
  store::publish_file(folder_.partial_result(), folder_.result());
  return summary;
}

}  // namespace cellcrush::worker
