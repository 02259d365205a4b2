#pragma once

#include <vector>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::jobs {

/// Error that the plateau stresses may have unless a request says otherwise.
inline constexpr double kWantedError = 0.05;

/// How far the results of a sweep over the elements per wall have converged. `rows` are all of its table. Throws
/// ServiceError (failed_precondition) for a sweep over other fields.
v1::Convergence convergence_of(const v1::Sweep& sweep, const std::vector<v1::SweepTable::Row>& rows,
                               double wanted_error);

}  // namespace cellcrush::jobs
