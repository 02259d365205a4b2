#include "worker/run_output.h"

#include <utility>

#include "store/durable_file.h"
#include "translate/results.h"

namespace cellcrush::worker {
namespace {

ProgressMeter meter_of(const SceneFacts& facts, std::int64_t first_step) {
  return {facts.step_count, Summary::kPlateauLow, Summary::kPlateauHigh, ProgressMeter::Clock::now(), first_step};
}

}  // namespace

RunOutput::RunOutput(const JobFolder& folder, ReportLog& log, const v1::Case& submitted, const Scene& scene)
    : folder_(folder),
      log_(log),
      case_(submitted),
      facts_(facts_of(scene)),
      mesh_(translate::to_proto(mesh_of(scene), facts_.particle_count)),
      meter_(meter_of(facts_, 0)),
      writer_(folder.partial_result(), mesh_) {}

bool RunOutput::restore(std::vector<Sample> samples, int frame_count, std::int64_t step) {
  meter_ = meter_of(facts_, step);
  for (auto& sample : samples) record(std::move(sample));
  ReportLogReader reader(folder_.reports());
  Report report;
  while (frame_count_ < frame_count && reader.read(report) == ReportLogReader::Read::message) {
    if (report.has_frame() && report.frame().index() == frame_count_) record(report.frame());
  }
  return frame_count_ == frame_count;
}

void RunOutput::put_mesh() {
  Report report;
  *report.mutable_mesh() = mesh_;
  log_.append(report);
}

void RunOutput::put_sample(Sample sample) {
  Report report;
  *report.mutable_sample() = record(std::move(sample));
  log_.append(report);
}

v1::Sample RunOutput::record(Sample sample) {
  auto out = translate::to_proto(sample, case_.lattice().frame().watched_nodes());
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

void RunOutput::finish(const store::ResultHeader& header, const v1::Summary& summary) {
  writer_.finish(header, summary);
  store::publish_file(folder_.partial_result(), folder_.result());
}

}  // namespace cellcrush::worker
