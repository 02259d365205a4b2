#pragma once

#include <span>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "fracture/failure.h"

namespace cellcrush {

/// Fills StartOverlaps of `after` and State::parted: those of `before` that have not parted, and those of new ends.
/// What a joint held together lies closer than walls that touch. Until it has parted, its reach is what it was while it
/// was joined (E8a), or just less than the distance where nothing could touch, so that no contact begins with a push
/// (E8f). REQUIRES: after = part_mesh(before, ends); `state` is still that of `before`.
void limit_new_ends(const Scene& before, std::span<const FailedEnd> ends, Scene& after, State& state);

/// Fills StartOverlaps of a scene with pairs that are sorted by ball.
void put_overlaps(std::vector<StartOverlap> pairs, Scene& scene);

}  // namespace cellcrush
