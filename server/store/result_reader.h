#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "store/hdf5.h"

namespace cellcrush::store {

/// Reads one complete result.h5 (result_format.md). A file whose bytes have changed since it was written is refused
/// before HDF5 sees it (result_seal.h), and a dataset that is not as ResultWriter makes it before it is read
/// (result_dataset.h). Not thread-safe. Failures throw ServiceError.
class ResultReader {
 public:
  explicit ResultReader(const std::filesystem::path& path);

  /// Attribute of the file.
  [[nodiscard]] std::string text_attribute(const char* name) const;
  /// All samples; step and contact_count are not in the file and stay 0.
  [[nodiscard]] std::vector<v1::Sample> history() const;
  [[nodiscard]] std::vector<double> frame_times() const;
  [[nodiscard]] std::vector<double> frame_strains() const;
  /// Throws ServiceError (data_loss) when there is none of that index.
  [[nodiscard]] v1::FieldFrame frame(int index) const;

 private:
  [[nodiscard]] std::vector<double> column(const char* group, const char* name) const;

  Hdf5Handle file_;
};

}  // namespace cellcrush::store
