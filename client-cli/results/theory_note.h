#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

/// Why the closed forms do not describe the crush of a lattice, in one or two sentences; empty if they do.
std::string theory_note(const v1::Lattice& lattice);

}  // namespace cellcrush::client
