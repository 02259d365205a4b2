#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "store/hdf5.h"
#include "store/result_layout.h"

namespace cellcrush::store {

/// Metadata of a result.
struct ResultHeader {
  v1::Job job;  ///< as it ended, with its case, its summary and its words
  std::string solver_revision;
  std::string simd_target;
  int threads = 1;
  double time_step_s = 0.0;
  std::vector<std::string> modelled;
  std::string citation{};
  std::string device = "none";  ///< what advanced the run beside the processor, or why nothing did
};

/// Writes one result.h5 (result_format.md). Not thread-safe. Failures throw ServiceError: storage_full or internal.
class ResultWriter {
 public:
  /// Creates a new file, replacing an existing one.
  ResultWriter(const std::filesystem::path& path, const v1::Mesh& mesh);

  void add_sample(const v1::Sample& sample);
  /// Frame 0 comes first; its positions are those of the mesh.
  void add_frame(const v1::FieldFrame& frame);
  /// Writes the buffered rows and the attributes, closes the file and seals it (result_seal.h). Must be the last call.
  void finish(const ResultHeader& header);

 private:
  void write_mesh(const v1::Mesh& mesh);
  void make_frames();
  void make_local_strain();
  /// Makes those of this sample that are not there yet.
  void make_columns(const v1::Sample& sample);
  void write_gathered();
  void write_positions(const v1::FieldFrame& frame);
  void write_breaks();
  void write_identity(const ResultHeader& header);

  std::filesystem::path path_;
  hsize_t particle_count_;
  hsize_t element_count_;
  hsize_t wall_count_;
  Hdf5Handle file_;
  Hdf5Handle mesh_;
  Hdf5Handle particles_;  ///< a dimension, as the next three
  Hdf5Handle elements_;
  Hdf5Handle walls_;
  Hdf5Handle axes_;
  std::vector<std::pair<HistoryColumn, Hdf5Handle>> columns_;  ///< in the order of history_columns
  Hdf5Handle frame_time_;
  Hdf5Handle frame_strain_;
  Hdf5Handle frame_position_;
  Hdf5Handle frame_plastic_;
  Hdf5Handle frame_fibre_strain_;
  Hdf5Handle frame_local_strain_;  ///< of lattices with cells
  std::vector<v1::Sample> gathered_;
  std::vector<v1::Break> breaks_;
  std::vector<std::int64_t> frame_breaks_;  ///< of each frame, how many there were
  std::vector<float> frame_ends_;           ///< positions of the broken ends, frame after frame
  bool has_positions_ = false;
};

/// Size of a result: its datasets as they are usually compressed, and the structure of the file.
std::int64_t predicted_result_bytes(std::int64_t particles, std::int64_t elements, std::int64_t walls,
                                    std::int64_t samples, std::int64_t frames);

/// Size of the reports of the same run.
std::int64_t predicted_report_bytes(std::int64_t particles, std::int64_t elements, std::int64_t walls,
                                    std::int64_t samples, std::int64_t frames);

}  // namespace cellcrush::store
