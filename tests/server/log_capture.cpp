#include "server/log_capture.h"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <mutex>
#include <sstream>
#include <utility>

namespace cellcrush::testing {

class LogCapture::Sink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  std::string text() {
    const std::scoped_lock lock(mutex_);
    return text_;
  }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    text_.append(line.data(), line.size());
  }
  void flush_() override {}

  std::string text_;
};

LogCapture::LogCapture(std::unique_ptr<spdlog::formatter> form)
    : sink_(std::make_shared<Sink>()), before_(spdlog::default_logger()) {
  sink_->set_formatter(std::move(form));
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("captured", sink_));
}

LogCapture::~LogCapture() { spdlog::set_default_logger(before_); }

std::string LogCapture::text() const { return sink_->text(); }

int LogCapture::count_lines(const std::string& words) const {
  std::istringstream lines(text());
  int out = 0;
  for (std::string line; std::getline(lines, line);) out += line.find(words) == std::string::npos ? 0 : 1;
  return out;
}

}  // namespace cellcrush::testing
