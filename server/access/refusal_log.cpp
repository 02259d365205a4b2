#include "access/refusal_log.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace cellcrush::access {
namespace {

constexpr std::chrono::seconds kBetweenLines{1};

}  // namespace

RefusalLog::RefusalLog(std::function<Clock::time_point()> now) : now_(std::move(now)) {}

RefusalLog::~RefusalLog() {
  if (left_out_ > 0) spdlog::warn("{} more calls were refused", left_out_);
}

void RefusalLog::note(const std::string& words) {
  const auto now = now_();
  int left_out = 0;
  {
    const std::scoped_lock lock(mutex_);
    if (last_line_ && now - *last_line_ < kBetweenLines) {
      ++left_out_;
      return;
    }
    last_line_ = now;
    left_out = std::exchange(left_out_, 0);
  }
  spdlog::warn("refused with {}{}", words, left_out == 0 ? "" : fmt::format(" ({} more before it)", left_out));
}

}  // namespace cellcrush::access
