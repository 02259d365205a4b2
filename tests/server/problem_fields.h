#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::testing {

/// The fields that problems name, in their order.
inline std::vector<std::string> fields_of(const Problems& problems) {
  std::vector<std::string> out;
  for (const auto& problem : problems) out.push_back(problem.field);
  return out;
}

inline std::vector<std::string> fields_of(const v1::CheckCaseResponse& response) {
  std::vector<std::string> out;
  for (const auto& problem : response.problems()) out.push_back(problem.field());
  return out;
}

}  // namespace cellcrush::testing
