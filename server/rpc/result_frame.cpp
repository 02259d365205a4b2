#include "rpc/result_frame.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "error.h"

namespace cellcrush::rpc {
namespace {

// Position of the value nearest to `wanted`.
int nearest(const std::vector<double>& values, double wanted) {
  const auto closer = [wanted](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); };
  return static_cast<int>(std::min_element(values.begin(), values.end(), closer) - values.begin());
}

}  // namespace

v1::FieldFrame read_frame(const store::ResultReader& result, const v1::GetFrameRequest& request) {
  const auto times = result.frame_times();
  const int last = static_cast<int>(times.size()) - 1;
  switch (request.which_case()) {
    case v1::GetFrameRequest::kStrain: return result.frame(nearest(result.frame_strains(), request.strain()));
    case v1::GetFrameRequest::kTimeS: return result.frame(nearest(times, request.time_s()));
    case v1::GetFrameRequest::kIndex:
      if (request.index() < -1 || request.index() > last) {
        throw ServiceError(ServiceError::Kind::out_of_range,
                           "index is " + std::to_string(request.index()) + ", but frames are numbered from 0 to " +
                               std::to_string(last) + ". Use one of these, or -1 for the last frame.");
      }
      return result.frame(request.index() == -1 ? last : request.index());
    case v1::GetFrameRequest::WHICH_NOT_SET: break;
  }
  return result.frame(last);
}

}  // namespace cellcrush::rpc
