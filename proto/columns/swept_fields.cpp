#include "columns/swept_fields.h"

#include <algorithm>

namespace cellcrush {

int count_values(const v1::SweepAxis& axis) {
  switch (axis.values_case()) {
    case v1::SweepAxis::kList: return axis.list().values_size();
    case v1::SweepAxis::kLinear: return axis.linear().count();
    case v1::SweepAxis::kLogarithmic: return axis.logarithmic().count();
    case v1::SweepAxis::kSeedCount: return axis.seed_count();
    case v1::SweepAxis::VALUES_NOT_SET: break;
  }
  return 0;
}

std::vector<std::string> swept_fields(const v1::Sweep& sweep) {
  std::vector<std::string> out;
  for (const auto& axis : sweep.axes()) out.push_back(axis.field());
  if (sweep.axes().empty() && !sweep.points().empty()) {
    for (const auto& [field, value] : sweep.points(0).fields()) out.push_back(field);
    std::sort(out.begin(), out.end());
  }
  return out;
}

}  // namespace cellcrush
