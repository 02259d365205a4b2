#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "worker/report.pb.h"

namespace cellcrush::worker {

/// What a worker has to say, as a file that outlives both it and the daemon: each record is the length of a Report and
/// its CRC-32, four bytes each and the least significant first, and then the Report. Written by one worker at a time,
/// read while it grows.
class ReportLog {
 public:
  /// Opens the log, or begins one, and cuts off what a worker that was killed left half-written at its end. Throws
  /// ServiceError.
  explicit ReportLog(const std::filesystem::path& path);
  ~ReportLog();
  ReportLog(const ReportLog&) = delete;
  ReportLog& operator=(const ReportLog&) = delete;

  /// A record that could not be written whole is taken back. Throws ServiceError: storage_full or internal.
  void append(const Report& report);

  /// Waits until all is on the disk. Throws ServiceError.
  void synchronize();

 private:
  void cut(std::uint64_t size);

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

/// Reads a log from its beginning.
class ReportLogReader {
 public:
  /// Throws ServiceError when there is no such file.
  explicit ReportLogReader(const std::filesystem::path& path);
  ~ReportLogReader();
  ReportLogReader(const ReportLogReader&) = delete;
  ReportLogReader& operator=(const ReportLogReader&) = delete;

  enum class Read {
    message,  ///< one was read
    end,      ///< no whole record is left, or not yet
    broken,   ///< what follows is no record
  };
  Read read(Report& report);

  /// Where the record behind the last one begins.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

 private:
  bool fill(std::size_t size);
  /// Whether the file has that many bytes from offset_ on.
  [[nodiscard]] bool is_so_long(std::size_t size) const;
  Read nothing_whole();

  int file_;
  std::uint64_t offset_ = 0;
  std::string buffer_;  ///< holds bytes of the file from taken_ to end_, which begin at offset_
  std::size_t taken_ = 0;
  std::size_t end_ = 0;
};

}  // namespace cellcrush::worker
