#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// "3.41 MPa".
std::string stress_text(double stress);

/// "V" of CRUSH_MODE_V; empty where none is known.
std::string crush_mode_code(v1::CrushMode mode);

/// The same in words: "V-shaped band (V)".
std::string crush_mode_text(v1::CrushMode mode);

/// What a run amounts to: of a crush its plateau stresses with theory beside them, front, crush mode and how
/// quasi-static it was where it was slow; of any run its ledger and contact, and what its reader must know.
std::string summary_text(const v1::Summary& summary, const v1::Lattice& lattice, int width = terminal_width());

}  // namespace cellcrush::client
