#pragma once

#include <span>
#include <string>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "error.h"
#include "store/hdf5.h"

namespace cellcrush::store {

/// The error message for a result that differs from ResultWriter's output: the disk or somebody has changed it.
ServiceError damaged_result(const std::string& what);

/// Opens the dataset at `path`, such as "history/strain", and holds it to what ResultWriter makes, before a number is
/// read:
///   - it lies in this file: neither a link on its path nor its storage leads to another one;
///   - its numbers are of `type`, which is one of HDF5's own, in `rank` dimensions, at least 1;
///   - it is contiguous, or its chunks are small, and there are no more numbers than what is stored can have been
///     deflated from.
/// So a damaged file costs no more than its size, and a hostile one opens no other. Throws ServiceError: data_loss for
/// what is otherwise, internal when HDF5 fails.
Hdf5Handle open_result_dataset(hid_t file, const std::string& path, hid_t type, int rank);

/// A dataset with a number for each sample: of the sample itself, of its front, or of a part of its frame.
struct HistoryColumn {
  std::string path;  ///< "history/strain", "history/front_strain_behind", "nodes/ID/ux_mm"
  const google::protobuf::FieldDescriptor* field = nullptr;  ///< int64 or double
  const google::protobuf::FieldDescriptor* owner = nullptr;  ///< field of Sample that holds its message; null: itself
  int part = 0;                                              ///< which one, if the owner is repeated

  /// "history", "nodes/ID".
  [[nodiscard]] std::string group() const { return path.substr(0, path.rfind('/')); }
  [[nodiscard]] hid_t type() const;
  /// NaN if the sample has no front.
  [[nodiscard]] double get(const v1::Sample& sample) const;
  /// NaN leaves a sample as it is.
  void set(std::span<v1::Sample> samples, std::span<const double> values) const;
};

/// The columns that result_format.md documents: of /history, one for every number of Sample and Front (sample.proto);
/// then of the watched nodes and rigid walls that this sample has.
std::vector<HistoryColumn> history_columns(const v1::Sample& sample = {});

/// A dataset of /breaks, with a number for each break: int64 or double.
struct BreakColumn {
  std::string path;
  const google::protobuf::FieldDescriptor* field = nullptr;  ///< of Break

  [[nodiscard]] hid_t type() const;
  [[nodiscard]] double get(const v1::Break& broken) const;
  void set(v1::Break& broken, double value) const;
};

/// One for each field of Break.
std::vector<BreakColumn> break_columns();

/// How many breaks there were in each frame, and the positions of their ends.
inline constexpr const char* kFrameBreaks = "frames/break_count";
inline constexpr const char* kFrameEnds = "frames/end_position_mm";

/// Writes the summary of a run as attributes of its result, without attributes for absent fields. Throws ServiceError.
void write_summary_attributes(hid_t file, const v1::Summary& summary);

/// Rows per chunk of /history; the writer buffers as many.
inline constexpr int kHistoryChunkRows = 256;

/// Maximum number of particles or elements in a chunk of a frame.
inline constexpr int kFrameChunkItems = 65536;

}  // namespace cellcrush::store
