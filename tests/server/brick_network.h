#pragma once

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::testing {

/// A network of bricks with uneven joints, as many as `columns` times `rows`, with a thickness for each wall: three
/// walls meet at most joints, so there are half as many walls more. Numbers of six decimals, in lists.
v1::Case brick_network(int columns, int rows);

}  // namespace cellcrush::testing
