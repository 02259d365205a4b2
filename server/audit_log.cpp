#include "audit_log.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "clocks.h"
#include "error.h"
#include "log_writer.h"
#include "store/durable_file.h"

namespace cellcrush {
namespace {

std::atomic<std::int64_t> lost_audit_lines = 0;

OpenFile open_audit_log(const std::filesystem::path& path) {
  if (path.empty()) return OpenFile();
  OpenFile out(store::open_file(path, O_WRONLY | O_APPEND | O_CREAT | O_NOCTTY | O_NONBLOCK, "opened"));
  struct stat status {};
  if (fstat(out.get(), &status) != 0 || S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode))
    throw ServiceError(ServiceError::Kind::invalid,
                       "--audit-log " + path.string() + " is a pipe, whose reader could stop the daemon. Use a file.");
  return out;
}

std::string line_of(const char* event, const std::vector<LogField>& fields) {
  std::string out = "{\"time\":" + json_string(google::protobuf::util::TimeUtil::ToString(time_now())) +
                    ",\"event\":" + json_string(event);
  for (const auto& field : fields) {
    if (!field.value.empty()) out += "," + json_string(field.key) + ":" + json_string(field.value);
  }
  return out + "}\n";
}

}  // namespace

AuditLog::AuditLog(std::filesystem::path path) : path_(std::move(path)), file_(open_audit_log(path_)) {
  if (path_.empty()) return;
  thread_ = std::jthread([this](const std::stop_token& stop) { write_refusals(stop); });
}

AuditLog::~AuditLog() { thread_ = {}; }

std::int64_t AuditLog::lost_lines() { return lost_audit_lines; }

void AuditLog::reopen() {
  try {
    OpenFile next = open_audit_log(path_);
    const MutexLock lock(mutex_);
    file_ = std::move(next);
  } catch (const ServiceError& error) {
    spdlog::error("{} The audit log goes on in the file that was open.", error.what());
  }
}

void AuditLog::write(const std::string& line) {
  if (path_.empty()) return;
  const MutexLock lock(mutex_);
  // A line that was written in part ends here.
  const bool written = write_text(file_.get(), failed_ ? "\n" + line : line);
  const int error = errno;
  if (!written) ++lost_audit_lines;
  if (std::exchange(failed_, !written) == !written) return;
  written ? spdlog::info("the audit log is written again")
          : spdlog::error("The audit log {} cannot be written: {}. Calls are still answered.", path_.string(),
                          std::generic_category().message(error));
}

void AuditLog::note_event(const std::string& event, const std::string& detail) {
  write(line_of(event.c_str(), {{"detail", detail}}));
}

void AuditLog::note_change(const std::string& resource, const std::string& done, const std::string& caller,
                           const std::string& request_id) {
  write(line_of("change", {{"caller", caller}, {"resource", resource}, {"action", done}, {"request", request_id}}));
}

void AuditLog::note_refusal(const std::string& method, const std::string& caller, const std::string& code,
                            const std::string& why) {
  if (path_.empty()) return;
  {
    const MutexLock lock(refusals_mutex_);
    const auto now = Clock::now();
    const std::chrono::duration<double> passed = now - std::exchange(since_, now);
    allowed_ = std::min<double>(kMostRefusals, allowed_ + passed.count());
    if (allowed_ < 1.0) {
      ++left_out_;
      return;
    }
    allowed_ -= 1.0;
    const int left_out = std::exchange(left_out_, 0);
    refusals_.push_back(line_of("refusal", {{"caller", caller},
                                            {"method", method},
                                            {"code", code},
                                            {"reason", why},
                                            {"left_out", left_out == 0 ? "" : std::to_string(left_out)}}));
  }
  refused_.notify_all();
}

void AuditLog::write_refusals(const std::stop_token& stop) {
  while (true) {
    std::vector<std::string> lines;
    {
      MutexLock lock(refusals_mutex_);
      refused_.wait(lock, stop, [this]() CELLCRUSH_REQUIRES(refusals_mutex_) { return !refusals_.empty(); });
      lines.swap(refusals_);
    }
    if (lines.empty()) return;
    for (const auto& line : lines) write(line);
  }
}

}  // namespace cellcrush
