#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "error.h"
#include "open_file.h"
#include "store/own_folder.h"

namespace cellcrush::store {

/// Throws that `path` cannot be `used` (used, written), with the reason of `error`, an errno. ServiceError: with the
/// shortage that the errno means, else internal.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view used, int error);

/// Opens a file that a user names, with these flags and O_CLOEXEC; a new one is its owner's only. Throws that it cannot
/// be `used`.
OpenFile open_file(const std::filesystem::path& path, int flags, std::string_view used = "written");

/// The same for a file or folder of the daemon's own (own_folder.h).
OpenFile open_own(const std::filesystem::path& path, int flags, std::string_view used = "written");

/// The same for reading. Throws ServiceError: of this kind for a link or anything but a regular file, and the errors of
/// throw_file_error.
OpenFile open_to_read(const std::filesystem::path& path, ServiceError::Kind otherwise = ServiceError::Kind::internal,
                      LastLink link = LastLink::refused);

/// Reads `most` bytes at `offset`; fewer only at the end of the file. Throws the errors of throw_file_error.
std::size_t read_at(const OpenFile& file, const std::filesystem::path& path, void* to, std::size_t most,
                    std::uint64_t offset);

/// Writes all bytes where the file stands. Throws the errors of throw_file_error.
void write_all(const OpenFile& file, const std::filesystem::path& path, std::string_view bytes);

/// Copies a file over another one, in pieces. Throws the errors of throw_file_error, and ServiceError (exhausted) if
/// the file has more than `most` bytes.
void copy_own(const std::filesystem::path& from, const std::filesystem::path& to,
              std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// Throws that error for a file of this size.
void require_size(const std::filesystem::path& path, std::uint64_t size, std::uint64_t most);

/// Makes the bytes of a file durable, whoever wrote them. False if there is no such file that can be read. Throws the
/// errors of throw_file_error.
bool synchronize_file(const std::filesystem::path& path);

/// Renames a complete file to its final name so that it survives a power loss: fsync, rename, fsync of the folder. Both
/// names are in the same folder. Throws the errors of throw_file_error.
void publish_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// A regular file open for reading. Thread-safe. Failures throw ServiceError.
class InputFile {
 public:
  /// Throws data_loss for anything but a regular file, such as a FIFO, without blocking.
  explicit InputFile(const std::filesystem::path& path, LastLink link = LastLink::refused);

  /// Size when it was opened.
  [[nodiscard]] std::int64_t size() const { return size_; }

  /// Up to `most` bytes starting at `offset`; fewer only at the end of the file.
  [[nodiscard]] std::string read(std::int64_t offset, std::size_t most) const;

 private:
  std::filesystem::path path_;
  OpenFile file_;
  std::int64_t size_ = 0;
};

}  // namespace cellcrush::store
