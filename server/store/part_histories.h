#pragma once

#include <span>
#include <string>
#include <vector>

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "store/hdf5.h"

namespace cellcrush::store {

/// Parts of a case of which a sample has numbers. In a result, each has a group in `group`, and in it a dataset for
/// each number of the sample's message.
struct PartKind {
  const char* group;
  const google::protobuf::FieldDescriptor* field;  ///< of Sample
};

/// /nodes/{id}: watched nodes.
PartKind watched_nodes();
/// /rigid_walls/{id}.
PartKind rigid_walls();

/// Writes the numbers of the parts of a case to a result, with one row per sample, parallel to /history. Writes
/// nothing without such parts. Failures throw ServiceError.
class PartHistories {
 public:
  explicit PartHistories(const PartKind& kind) : kind_(kind) {}

  /// Appends the rows of samples with the same parts. `file` is the open result.
  void append(hid_t file, std::span<const v1::Sample> samples);
  void close();

 private:
  struct Part {
    Hdf5Handle group;
    std::vector<Hdf5Handle> columns;
  };

  void make_parts(hid_t file, const v1::Sample& sample);

  PartKind kind_;
  Hdf5Handle all_;
  std::vector<Part> written_;
};

/// Adds the parts of a case to samples from row `first` on of an open result. Throws ServiceError: data_loss for a
/// dataset that is missing or differs from what was written.
void read_parts(hid_t file, const v1::Case& scene, hsize_t first, std::span<v1::Sample> samples);

}  // namespace cellcrush::store
