#pragma once

#include <hdf5.h>

#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::store {

/// Writes what a run amounts to as attributes of its result (result_format.md); what is absent gets none. Failures
/// throw ServiceError.
void write_summary_attributes(hid_t file, const v1::Summary& summary);

}  // namespace cellcrush::store
