#pragma once

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/case.pb.h"

namespace cellcrush::translate {

/// The joints and walls of a network, from its lists or their compact form, without materials. A difference that leads
/// out of the numbers of joints gives the joint -1, which no network has.
NetworkWalls lists_of(const v1::Lattice::Network& network);

/// Adds what is wrong with the compact form itself: no steps, or lists beside it. What is wrong with the lists is for
/// the solver to find.
void check_compact(const v1::Lattice::Network& network, Problems& problems);

/// Gives problems of lists the names in the compact form that they were given in.
void name_compact(const v1::Lattice::Network& network, Problems& problems);

}  // namespace cellcrush::translate
