#pragma once

#include <optional>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "compare/force_curve.h"

namespace cellcrush::compare {

/// Compares tests with one job, which has its words, and whose samples come in their order. Throws InvalidField, and
/// ServiceError (failed_precondition) if the job has no curve yet.
class TestComparison {
 public:
  TestComparison(const v1::CompareTestRequest& request, const v1::Job& job, const std::optional<v1::Mesh>& mesh);
  void add(const v1::Sample& sample);
  [[nodiscard]] v1::CompareTestResponse result() const;

 private:
  const v1::CompareTestRequest& request_;
  std::optional<ForceParts> parts_;   ///< nothing: stress between plates
  std::optional<Specimen> specimen_;  ///< nothing: of a force
  bool has_support_ = true;
  std::vector<CurvePoint> points_;
};

}  // namespace cellcrush::compare
