#pragma once

#include <cstddef>
#include <functional>

#include "beam/walls_workspace.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Whether the vector kernels are compiled for a rule: for the default's 4 x 6 points, force-based, and the paper's 2 x 6,
/// displacement-based. Others are left to the plain text.
inline bool has_vector_kernel(const SectionRule& rule) {
  const std::size_t sections = rule.force_based ? 4 : 2;
  return rule.section_count() == sections && rule.depth_count() == 6;
}

/// Of larger lattices, what passes between the loops over geometry and fibres is better left in the nearest cache than kept for
/// all elements while others go on: with 16 times the cells of Type I two threads lose a third, with 4 times nothing.
inline constexpr std::size_t kMostElementsBeside = 20'000;

/// evaluate_internal_forces with the processor's vector instructions, the walls of a block at once: the same equations as
/// evaluate_element. REQUIRES: has_vector_kernel.
void evaluate_walls_wide(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers,
                         const std::function<void()>& meanwhile);

/// The same of a band's walls, and the sums of joints that have no walls behind them. Overwrites each chunk's plastic work,
/// N mm, which is not booked. REQUIRES: the bands before have been evaluated.
void evaluate_band_walls_wide(const Scene& scene, State& state, const LatticeBand& band, WallsWorkspace& workspace,
                              double* plastic_work);

}  // namespace cellcrush
