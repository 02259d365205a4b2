#include "compare/compare_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "compare/curve_difference.h"
#include "error.h"

namespace cellcrush::compare {
namespace {

// Without plates, two rigid walls take their part; one alone has no support.
bool has_support(const v1::Job& job) {
  const auto is_side = [](const v1::RigidWallSummary& wall) { return wall.wall().starts_with("side_"); };
  return job.words().plates() || std::ranges::count_if(job.summary().rigid_walls(), std::not_fn(is_side)) != 1;
}

[[noreturn]] void refuse_without_samples() {
  throw ServiceError(ServiceError::Kind::failed_precondition,
                     "The job has no samples yet. Compare again once it has run.");
}

Specimen specimen_of(const v1::Job& job, const std::optional<v1::Mesh>& mesh) {
  if (!job.words().plates() && !job.words().rigid_wall_plates()) {
    throw InvalidField("force_part", "is missing: " + job.name() + " has no lattice between plates.",
                       "Name the rigid wall, grip or watched node whose force to compare.");
  }
  if (!mesh) refuse_without_samples();
  return {mesh->length_mm(), mesh->width_mm() * job.case_().depth_mm()};
}

ComparedRanges ranges_of(const v1::CompareTestRequest& request) {
  ComparedRanges out;
  if (request.has_energy_to()) out.energy_to = request.energy_to();
  if (request.has_window_low() != request.has_window_high())
    throw InvalidField(request.has_window_low() ? "window_high" : "window_low", "is missing.", "Give both ends.");
  if (!request.has_window_low()) return out;
  if (!(request.window_low() >= 0.0 && request.window_high() > request.window_low()))
    throw InvalidField("window_low",
                       fmt::format("is {:.4g}, and window_high {:.4g}.", request.window_low(), request.window_high()),
                       "Give two that are not negative, the smaller one first.");
  out.window = {request.window_low(), request.window_high()};
  return out;
}

void write(const CurveNumbers& numbers, v1::CompareTestResponse::Numbers& out) {
  if (numbers.slope) out.set_slope(*numbers.slope);
  if (numbers.peak) out.set_peak(*numbers.peak);
  if (numbers.peak_at) out.set_peak_at(*numbers.peak_at);
  if (numbers.mean) out.set_mean(*numbers.mean);
  out.set_energy(numbers.energy);
}

v1::CompareTestResponse to_response(const CurveDifference& difference) {
  v1::CompareTestResponse out;
  out.set_is_force(difference.kind == CurveKind::force_displacement);
  out.set_from(difference.common.from);
  out.set_to(difference.common.to);
  out.set_window_low(difference.window.from);
  out.set_window_high(difference.window.to);
  out.set_energy_to(difference.energy_to);
  write(difference.measured, *out.mutable_measured());
  write(difference.computed, *out.mutable_computed());
  out.set_greatest_difference(difference.greatest);
  out.set_greatest_difference_at(difference.greatest_at);
  out.set_rms_difference(difference.rms);
  out.mutable_x()->Add(difference.x.begin(), difference.x.end());
  out.mutable_measured_mean()->Add(difference.mean.begin(), difference.mean.end());
  out.mutable_measured_least()->Add(difference.least.begin(), difference.least.end());
  out.mutable_measured_most()->Add(difference.most.begin(), difference.most.end());
  out.mutable_computed_y()->Add(difference.computed_y.begin(), difference.computed_y.end());
  return out;
}

}  // namespace

TestComparison::TestComparison(const v1::CompareTestRequest& request, const v1::Job& job,
                               const std::optional<v1::Mesh>& mesh)
    : request_(request), has_support_(has_support(job)) {
  if (request.tests().empty()) throw InvalidField("tests", "is empty.", "Give the text of at least one test.");
  if (request.force_part().empty() && !request.displacement_part().empty())
    throw InvalidField("force_part", "is missing.", "Name the part whose force goes with the displacement.");
  if (!request.force_part().empty()) {
    parts_.emplace(request.force_part(), request.displacement_part());
  } else {
    specimen_ = specimen_of(job, mesh);
  }
}

void TestComparison::add(const v1::Sample& sample) {
  if (parts_) {
    if (points_.empty()) parts_->check(sample);
    points_.push_back(parts_->point_of(sample));
  } else {
    points_.push_back({sample.strain(), has_support_ ? sample.stress_support_mpa() : sample.stress_impact_mpa()});
  }
}

v1::CompareTestResponse TestComparison::result() const {
  if (points_.empty()) refuse_without_samples();
  std::vector<Measurement> tests;
  for (const auto& test : request_.tests())
    tests.push_back(read_measurement(test.text(), test.name(), request_.columns(), specimen_));
  LoadCurve computed = loading_of(points_);
  if (parts_) align_sign(tests.front().curve, computed);
  const CurveKind kind = parts_ ? CurveKind::force_displacement : CurveKind::stress_strain;
  auto out = to_response(compare_curves(kind, computed, tests, ranges_of(request_)));
  out.set_job(request_.name());
  for (const auto& test : request_.tests()) out.add_tests(test.name());
  return out;
}

}  // namespace cellcrush::compare
