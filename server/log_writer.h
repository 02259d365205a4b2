#pragma once

#include <spdlog/sinks/base_sink.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string_view>

namespace cellcrush {

/// Writes all of it; blocks as long as nobody reads. False, if the bytes cannot be written: the terminal is gone, or
/// the disk is full.
bool write_text(int file, std::string_view text);

/// Sink of the log that never blocks a caller: its own thread writes the lines. They wait in a queue of 1 MiB while
/// nobody reads them, as behind a stalled pipe or a stopped terminal. Lines that do not fit are lost; a warning says
/// how many, once the log is read again.
class LogWriter final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  /// Appends to a file, created for its owner only; an empty path: writes to stderr. Throws ServiceError.
  explicit LogWriter(const std::filesystem::path& path);
  /// Waits as stop() does for what is queued.
  ~LogWriter() override;
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Opens the file by its name again, after it was moved away; no effect on stderr. The old one stays in use if that
  /// fails. Throws ServiceError.
  void reopen();

  /// Writes what is queued, for at most that long. Later lines are lost.
  void stop(std::chrono::milliseconds limit = std::chrono::seconds(1));

  /// Number of lines lost by all writers of this process.
  static std::int64_t lost_lines();

 private:
  struct State;

  void set_formatter_(std::unique_ptr<spdlog::formatter> form) override;
  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override {}

  std::filesystem::path path_;    ///< empty: stderr
  std::shared_ptr<State> state_;  ///< shared with the thread, which a blocked write may keep beyond this object
};

}  // namespace cellcrush
