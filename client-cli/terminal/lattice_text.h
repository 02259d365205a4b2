#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Summary of a lattice: "hexagons, 74 x 21 cells", "frame of 12 nodes and 11 beams".
std::string lattice_summary(const v1::Lattice& lattice);

/// Description of a lattice as pairs of heading and line: walls, imperfection and inclusions of a regular lattice;
/// beams, supports, loads and so on of a frame.
std::vector<std::pair<std::string, std::string>> lattice_description(const v1::Lattice& lattice);

}  // namespace cellcrush::client
