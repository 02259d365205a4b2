#pragma once

#include <hdf5.h>

#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::store {

/// Writes the summary of a run as attributes of its result (result_format.md), without attributes for absent fields.
/// Failures throw ServiceError.
void write_summary_attributes(hid_t file, const v1::Summary& summary);

}  // namespace cellcrush::store
