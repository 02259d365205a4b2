#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "store/hdf5.h"

namespace cellcrush::store {

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
