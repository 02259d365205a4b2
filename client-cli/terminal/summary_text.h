#pragma once

#include <string>

#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::client {

/// "3.41 MPa".
std::string stress_text(double stress);

/// "V" of CRUSH_MODE_V; empty where none is known.
std::string crush_mode_text(v1::CrushMode mode);

/// What a run amounts to: of a crush its plateau stresses with theory beside them, front, crush mode and how quasi-static
/// it was where it was slow; of any run its ledger and contact, and what its reader must know. `frame`: it has no plates.
std::string summary_text(const v1::Summary& summary, bool frame);

}  // namespace cellcrush::client
