#pragma once

#include <cstddef>

namespace cellcrush {

/// With more elements than this, the strains that pass between the walls' stages do not stay in the nearest cache, and two
/// threads do not overlap walls with contacts: with 16 times the cells of Type I they would lose a third, with 4 times nothing.
/// Speed only.
inline constexpr std::size_t kMostElementsOverlapped = 20'000;

}  // namespace cellcrush
