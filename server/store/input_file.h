#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace cellcrush::store {

/// A regular file open for reading, closed on destruction. Thread-safe. Failures throw ServiceError.
class InputFile {
 public:
  /// Also throws for anything but a regular file, such as a FIFO, without blocking.
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Size when it was opened.
  [[nodiscard]] std::int64_t size() const { return size_; }

  /// Up to `most` bytes starting at `offset`; fewer only at the end of the file.
  [[nodiscard]] std::string read(std::int64_t offset, std::size_t most) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace cellcrush::store
