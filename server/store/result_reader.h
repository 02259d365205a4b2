#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "store/hdf5.h"
#include "store/result_seal.h"

namespace cellcrush::store {

/// Reads one complete result.h5 (result_format.md). Refuses a file whose bytes have changed since it was written before
/// HDF5 opens it (result_seal.h), and a dataset that ResultWriter did not write before reading it (result_layout.h).
/// Not thread-safe. Failures throw ServiceError.
class ResultReader {
 public:
  explicit ResultReader(const std::filesystem::path& path);

  /// The file as check_seal found it.
  [[nodiscard]] const std::optional<FileIdentity>& file() const { return identity_; }

  /// The ended job (result_job.h).
  [[nodiscard]] v1::Job job() const;
  [[nodiscard]] v1::Mesh mesh() const;
  /// An attribute of the file.
  [[nodiscard]] std::string text_attribute(const char* name) const;
  /// Samples from number `first` on, counted from 0, `count` of them if there are so many; without their warnings.
  /// Columns that a result of an earlier version lacks stay 0.
  [[nodiscard]] std::vector<v1::Sample> history(std::int64_t first = 0,
                                                std::int64_t count = std::numeric_limits<std::int64_t>::max()) const;
  [[nodiscard]] std::vector<double> frame_times() const;
  [[nodiscard]] std::vector<double> frame_strains() const;
  /// Throws ServiceError (data_loss) if no frame has that index.
  [[nodiscard]] v1::FieldFrame frame(int index) const;

 private:
  [[nodiscard]] std::vector<double> column(const std::string& path, hid_t type, hsize_t first = 0,
                                           hsize_t count = std::numeric_limits<std::int64_t>::max()) const;
  [[nodiscard]] bool has(const std::string& path) const;
  /// All breaks, in their order.
  [[nodiscard]] std::vector<v1::Break> breaks() const;
  void add_breaks(std::int64_t first, std::vector<v1::Sample>& samples) const;
  void add_broken_ends(std::size_t row, v1::FieldFrame& frame) const;
  /// A sample with the parts of the case that samples have numbers of.
  [[nodiscard]] v1::Sample sample_without_numbers() const;

  std::optional<FileIdentity> identity_;
  Hdf5Handle file_;
};

}  // namespace cellcrush::store
