#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace cellcrush::store {

/// A regular file that is open for reading and closes itself. Thread-safe. Failures throw ServiceError.
class InputFile {
 public:
  /// Throws also where something else than a file has the name, such as a FIFO, on which it does not wait.
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Bytes when it was opened.
  [[nodiscard]] std::int64_t size() const { return size_; }

  /// Up to `most` bytes from `offset` on; fewer only at the end.
  [[nodiscard]] std::string read(std::int64_t offset, std::size_t most) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace cellcrush::store
