#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::e2e {

/// Reads a result.h5 with the C interface of HDF5. Every function throws std::runtime_error, naming the object, when
/// something is not there or cannot be read. Not thread-safe.
class ResultFile {
 public:
  explicit ResultFile(const std::filesystem::path& path);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// Extent of a dataset.
  [[nodiscard]] std::vector<std::int64_t> shape(const std::string& name) const;
  /// All values of a dataset, rows first.
  [[nodiscard]] std::vector<double> values(const std::string& name) const;
  /// Whether a dataset may grow along its first dimension, and is compressed.
  [[nodiscard]] bool is_extendible_and_compressed(const std::string& name) const;
  /// Bytes of a number of the dataset.
  [[nodiscard]] int number_size(const std::string& name) const;
  /// Names of the attributes of the root group, sorted.
  [[nodiscard]] std::vector<std::string> attributes() const;

 private:
  std::int64_t file_ = -1;
};

}  // namespace cellcrush::e2e
