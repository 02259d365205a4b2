#pragma once

#include <spdlog/formatter.h>
#include <spdlog/logger.h>

#include <memory>
#include <string>

namespace cellcrush::testing {

/// What this process logs in one of its forms, from here until the object goes; the log of before then goes on.
class LogCapture {
 public:
  explicit LogCapture(std::unique_ptr<spdlog::formatter> form);
  ~LogCapture();
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  [[nodiscard]] std::string text() const;
  /// How many of its lines have the words in them.
  [[nodiscard]] int count_lines(const std::string& words) const;

 private:
  class Sink;
  std::shared_ptr<Sink> sink_;
  std::shared_ptr<spdlog::logger> before_;
};

}  // namespace cellcrush::testing
