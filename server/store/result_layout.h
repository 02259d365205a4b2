#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
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

/// A column of /history: a number of the sample, or one of its front, whose name then begins with "front_".
struct HistoryColumn {
  std::string name;
  const google::protobuf::FieldDescriptor* field = nullptr;
  bool is_of_front = false;
  bool is_count = false;  ///< int64, else float64

  [[nodiscard]] hid_t type() const { return is_count ? H5T_STD_I64LE : H5T_IEEE_F64LE; }
  /// NaN if the sample has no front.
  [[nodiscard]] double get(const v1::Sample& sample) const;
  /// NaN leaves the sample as it is.
  void set(v1::Sample& sample, double value) const;
};

/// All columns of /history, documented in result_format.md: every number of Sample and Front (sample.proto).
const std::vector<HistoryColumn>& history_columns();

/// Writes the summary of a run as attributes of its result, without attributes for absent fields. Throws ServiceError.
void write_summary_attributes(hid_t file, const v1::Summary& summary);

/// Rows per chunk of /history; the writer buffers as many.
inline constexpr int kHistoryChunkRows = 256;

/// Maximum number of particles or elements in a chunk of a frame.
inline constexpr int kFrameChunkItems = 65536;

}  // namespace cellcrush::store
