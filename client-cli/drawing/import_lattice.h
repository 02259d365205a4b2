#pragma once

#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::drawing {

/// Makes a network of a drawing, and reports what was read, merged, joined and left out. Throws DrawingError.
v1::ImportLatticeResponse import_lattice(const v1::ImportLatticeRequest& request);

}  // namespace cellcrush::drawing
