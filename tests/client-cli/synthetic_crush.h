#pragma once

#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "connection/frames.h"

namespace cellcrush::client::testing {

/// A honeycomb that is crushed from its low end by a front that leaves a fifth of the length behind it. It looks like a
/// crush and is no solution of anything: `columns` cells a row, sides of 4 mm, two elements a wall.
MeshFrame synthetic_stage(int columns, int rows, double strain, bool along_y = false);

/// Samples of a crush to `end_strain` with a plateau of 3.4 MPa at the impact plate and 0.45 MPa at the support plate,
/// noise, an initial peak and densification near the end.
std::vector<v1::Sample> synthetic_samples(int count, double end_strain);

}  // namespace cellcrush::client::testing
