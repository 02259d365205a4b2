#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "store/durable_file.h"
#include "store/report.pb.h"

namespace cellcrush::store {

/// A worker's reports, in a file that outlives worker and daemon. Each record holds the length of a Report and its
/// CRC-32, four bytes each in little-endian order, and then the Report. One worker at a time writes it; others read it
/// while it grows.
class ReportLog {
 public:
  /// Opens or creates the log, and truncates an incomplete record that a killed worker left at its end. Throws
  /// ServiceError.
  explicit ReportLog(const std::filesystem::path& path);

  /// An incomplete record is removed. Throws ServiceError: storage_full or internal.
  void append(const worker::Report& report);

  /// Waits until everything is on the disk. Throws ServiceError.
  void synchronize();

 private:
  void cut(std::uint64_t size);

  std::filesystem::path path_;
  OpenFile file_;
  std::uint64_t size_ = 0;
};

/// Reads a log, from its start unless told otherwise.
class ReportLogReader {
 public:
  /// Throws ServiceError if the file does not exist.
  explicit ReportLogReader(const std::filesystem::path& path) : file_(open_to_read(path)) {}

  enum class Read {
    message,  ///< a report was read
    end,      ///< no complete record is available, or not yet
    broken,   ///< the next bytes are not a record
  };
  Read read(worker::Report& report);

  /// Reads the next report with a sample. Large ones of other kinds are skipped unread, so damage in them goes
  /// unnoticed.
  Read read_sample(v1::Sample& sample);

  /// Appends the next record to `bytes`, with its length and checksum. False if no complete and intact one is
  /// available.
  bool read_record(std::string& bytes);

  /// Continues at this offset, which is that of a record. REQUIRES: nothing was read.
  void start_at(std::uint64_t offset) { offset_ = offset; }

  /// Offset after the last record.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

 private:
  /// Makes this many bytes after offset_ available; false if the file has fewer.
  bool fill(std::size_t size);
  /// The next record, with its length and checksum.
  Read next_record(std::string_view& record);
  /// Whether the next record, which has this size, holds one message and nothing else.
  bool is_one_message(std::size_t size);
  /// Whether the file has this many bytes after offset_.
  [[nodiscard]] bool is_so_long(std::size_t size) const;
  Read nothing_whole();
  void pass(std::size_t size);

  OpenFile file_;
  std::uint64_t offset_ = 0;
  std::string buffer_;          ///< never shrinks, since resizing would fill it with zeros
  std::string_view available_;  ///< bytes of the file from offset_ on, in the buffer
};

}  // namespace cellcrush::store
