#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "open_file.h"
#include "store/durable_file.h"

namespace cellcrush::worker {

// Files that do not fit into memory beside what they hold. Not thread-safe. Failures throw ServiceError.

/// Writes a new file; small pieces together.
class PieceWriter {
 public:
  explicit PieceWriter(const std::filesystem::path& path);

  void write(std::string_view bytes);
  void close();

 private:
  void flush();

  std::filesystem::path path_;
  OpenFile file_;
  std::string gathered_;
};

/// Reads a regular file from its start on.
class PieceReader {
 public:
  explicit PieceReader(const std::filesystem::path& path) : file_(path) {}

  /// Bytes up to the end.
  [[nodiscard]] std::uint64_t left() const { return static_cast<std::uint64_t>(file_.size()) - place_; }
  [[nodiscard]] std::uint64_t place() const { return place_; }
  void go_to(std::uint64_t place) { place_ = place; }

  /// Some of the next bytes, at most `most`; valid until the next read. REQUIRES: not at the end.
  std::string_view next(std::uint64_t most);
  /// Reads all or none; false if there are fewer.
  bool read(char* to, std::size_t size);

 private:
  store::InputFile file_;
  std::string piece_;
  std::uint64_t start_ = 0;  ///< place of the piece in the file
  std::uint64_t place_ = 0;
};

}  // namespace cellcrush::worker
