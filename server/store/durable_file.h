#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace cellcrush::store {

/// Throws that `path` cannot be `used` (used, written), with the reason of `error`, an errno. ServiceError: with the
/// shortage that the errno means, else internal.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view used, int error);

/// Opens a regular file for reading; never blocks, as opening a FIFO would. Returns the descriptor, owned by the
/// caller. Throws ServiceError: internal for another kind of file, or if it cannot be opened.
int open_to_read(const std::filesystem::path& path);

/// Makes the bytes of a file durable, whoever wrote them. False if there is no such file that can be read. Throws the
/// errors of throw_file_error.
bool synchronize_file(const std::filesystem::path& path);

/// Renames a complete file to its final name so that it survives a power loss: fsync, rename, fsync of the folder. Both
/// names are in the same folder. Throws the errors of throw_file_error.
void publish_file(const std::filesystem::path& from, const std::filesystem::path& to);

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
