#pragma once

#include <string>

#include "error.h"
#include "store/hdf5.h"

namespace cellcrush::store {

/// The error message for a result that differs from ResultWriter's output: the disk or somebody has changed it.
ServiceError damaged_result(const std::string& what);

/// Opens the dataset `name` of the group `group` of a result and holds it to what ResultWriter makes, before a number
/// is read:
///   - it lies in this file: neither a link nor its storage leads to another one;
///   - its numbers are of `type`, which is one of HDF5's own, in `rank` dimensions, at least 1;
///   - its chunks are small, and there are no more numbers than what is stored can have been deflated from.
/// So a damaged file costs no more than its size, and a hostile one opens no other. Throws ServiceError: data_loss for
/// what is otherwise, internal when HDF5 fails.
Hdf5Handle open_result_dataset(hid_t file, const std::string& group, const std::string& name, hid_t type, int rank);

}  // namespace cellcrush::store
