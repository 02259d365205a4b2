#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// What a lattice is, in a few words: "hexagons, 74 x 21 cells", "frame of 12 nodes and 11 beams".
std::string lattice_summary(const v1::Lattice& lattice);

/// What a lattice is, as pairs of a heading and a line of text: walls, imperfection and inclusions of a regular
/// lattice; beams, supports, loads and the rest of a frame.
std::vector<std::pair<std::string, std::string>> lattice_description(const v1::Lattice& lattice);

}  // namespace cellcrush::client
