#include "limited_log.h"

#include <google/protobuf/stubs/logging.h>
#include <grpc/support/log.h>
#include <spdlog/spdlog.h>

#include <string_view>
#include <utility>

namespace cellcrush {
namespace {

constexpr std::chrono::seconds kWindow{1};

constexpr int kLinesPerSecond = 10;
constexpr std::size_t kLongestMessage = 500;

spdlog::level::level_enum level_of(gpr_log_severity severity) {
  switch (severity) {
    case GPR_LOG_SEVERITY_DEBUG: return spdlog::level::debug;
    case GPR_LOG_SEVERITY_INFO: return spdlog::level::info;
    case GPR_LOG_SEVERITY_ERROR: break;
  }
  return spdlog::level::err;
}

spdlog::level::level_enum level_of(google::protobuf::LogLevel level) {
  switch (level) {
    case google::protobuf::LOGLEVEL_INFO: return spdlog::level::info;
    case google::protobuf::LOGLEVEL_WARNING: return spdlog::level::warn;
    case google::protobuf::LOGLEVEL_ERROR: return spdlog::level::err;
    case google::protobuf::LOGLEVEL_FATAL: break;
  }
  return spdlog::level::critical;
}

// Both libraries have a single handler for the whole process.
class LibraryLog {
 public:
  static LibraryLog& instance() {
    // Creates the logger registry first, so that it outlives this object.
    static_cast<void>(spdlog::default_logger_raw());
    static LibraryLog log;
    return log;
  }

  LibraryLog(const LibraryLog&) = delete;
  LibraryLog& operator=(const LibraryLog&) = delete;

 private:
  LibraryLog() {
    gpr_set_log_function(
        [](gpr_log_func_args* line) { instance().write("gRPC", level_of(line->severity), line->message); });
    before_ = google::protobuf::SetLogHandler(
        [](google::protobuf::LogLevel level, const char*, int, const std::string& message) {
          instance().write("protobuf", level_of(level), message);
        });
  }

  ~LibraryLog() {
    gpr_set_log_function(nullptr);
    google::protobuf::SetLogHandler(before_);
  }

  void write(const char* library, spdlog::level::level_enum level, std::string_view message) {
    const bool is_long = message.size() > kLongestMessage;
    lines_.write(level, fmt::format("{}: {}{}", library, message.substr(0, kLongestMessage), is_long ? "..." : ""));
  }

  google::protobuf::LogHandler* before_ = nullptr;
  LimitedLog lines_{"log lines of gRPC and protobuf", kLinesPerSecond};
};

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

void redirect_library_logs() { LibraryLog::instance(); }

}  // namespace cellcrush
