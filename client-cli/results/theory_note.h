#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Why the closed forms do not describe the crush of a lattice, in a sentence or two; empty where they do.
std::string theory_note(const v1::Lattice& lattice);

}  // namespace cellcrush::client
