#pragma once

#include <cstddef>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::drawing {

/// Bytes above which the lists of a network are written in the compact form: below the limit of a case, 4,000,000, so
/// that the rest of it has room.
inline constexpr std::size_t kLargestLists = 3'900'000;

/// What the compact form may do to numbers.
enum class Rounding {
  none,  ///< each comes out bit by bit: they have at most nine decimals, all alike
  to_a_step,
};

/// Writes the lists of a network in their compact form, with the fewest steps in a mm that keep all numbers, or with up
/// to 1,000,000 if they may be rounded. False, and no change, if the numbers do not fit into the form.
bool make_compact(v1::Lattice::Network& network, Rounding rounding);

}  // namespace cellcrush::drawing
