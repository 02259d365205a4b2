#include "limited_log.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace cellcrush {
namespace {

constexpr std::chrono::seconds kWindow{1};

}  // namespace

LimitedLog::LimitedLog(std::string kind, int lines_per_second, std::function<Clock::time_point()> now)
    : kind_(std::move(kind)), lines_per_second_(lines_per_second), now_(std::move(now)), second_(now_() - kWindow) {}

LimitedLog::~LimitedLog() {
  if (left_out_ > 0) spdlog::warn("{} more {} not logged", left_out_, kind_);
}

void LimitedLog::write(spdlog::level::level_enum level, const std::string& words) {
  const auto now = now_();
  int left_out = 0;
  {
    const MutexLock lock(mutex_);
    if (now - second_ >= kWindow) {
      second_ = now;
      lines_ = 0;
    }
    if (lines_ == lines_per_second_) {
      ++left_out_;
      return;
    }
    ++lines_;
    left_out = std::exchange(left_out_, 0);
  }
  spdlog::log(level, "{}{}", words, left_out == 0 ? "" : fmt::format(" ({} more not logged)", left_out));
}

}  // namespace cellcrush
