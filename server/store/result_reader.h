#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cellcrush/v1/sample.pb.h"
#include "store/hdf5.h"

namespace cellcrush::store {

/// Reads one complete result.h5 (result_format.md). Not thread-safe. Failures throw ServiceError.
class ResultReader {
 public:
  explicit ResultReader(const std::filesystem::path& path);

  /// Attribute of the file.
  [[nodiscard]] std::string text_attribute(const char* name) const;
  /// All samples; step and contact_count are not in the file and stay 0.
  [[nodiscard]] std::vector<v1::Sample> history() const;
  [[nodiscard]] std::vector<double> frame_times() const;
  [[nodiscard]] std::vector<double> frame_strains() const;
  /// REQUIRES: 0 <= index < the number of frames.
  [[nodiscard]] v1::FieldFrame frame(int index) const;

 private:
  [[nodiscard]] Hdf5Handle dataset(const std::string& path) const;
  [[nodiscard]] std::vector<double> column(const std::string& path) const;

  Hdf5Handle file_;
};

}  // namespace cellcrush::store
