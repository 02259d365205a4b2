#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::client::testing {

/// A job of a crush at a speed in m/s, with progress if it has begun.
v1::Job make_job(int number, v1::Job::State state, double speed);

/// A sweep over 50, 100, 150 and 200 m/s of which the first `succeeded` jobs have, and the others failed.
v1::SweepTable make_table(int succeeded);

/// Two speeds with three seeds each; one job of the second has failed.
v1::SweepTable make_averaged_table();

/// Fields of proto text, such as "fields: 'depth_mm'", and a row for each list of values. The plateau stress in MPa is
/// the number of the row, so that no two are equal.
v1::SweepTable make_table(const char* fields, const std::vector<std::vector<double>>& rows);

std::vector<std::string> lines_of(const std::string& text);

}  // namespace cellcrush::client::testing
