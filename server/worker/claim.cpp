#include "worker/claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include "store/durable_file.h"

namespace cellcrush::worker {
namespace {

// A process that checks the claim holds the lock for an instant; a starting worker writes its id soon.
constexpr int kTries = 100;
constexpr std::chrono::milliseconds kBetweenTries{10};

bool is_locked(int file) {
  if (flock(file, LOCK_SH | LOCK_NB) != 0) return errno == EWOULDBLOCK;
  flock(file, LOCK_UN);
  return false;
}

std::optional<Claim> read_claim(int file) {
  std::array<char, 64> text{};
  const auto count = pread(file, text.data(), text.size(), 0);
  std::istringstream words(std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))));
  Claim out;
  if (words >> out.process >> out.start_time) return out;
  return std::nullopt;
}

}  // namespace

bool claim(const store::JobFolder& folder) {
  OpenFile claim = store::open_own(folder.claim(), O_RDWR | O_CREAT);
  for (int i = 0; flock(claim.get(), LOCK_EX | LOCK_NB) != 0; ++i) {
    if (i == kTries) return false;
    std::this_thread::sleep_for(kBetweenTries);
  }
  const auto times = times_of(getpid());
  const std::string text = std::to_string(getpid()) + " " + std::to_string(times ? times->start : 0) + "\n";
  // The file stays open, and locked, for as long as the process lives.
  const int file = claim.release();
  if (ftruncate(file, 0) != 0 || pwrite(file, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    store::throw_file_error(folder.claim(), "written", errno);
  return true;
}

std::optional<Claim> find_claim(const store::JobFolder& folder) {
  const OpenFile file = store::try_open_own(folder.claim(), O_RDONLY);
  if (!file && (errno == ENOENT || errno == ENOTDIR || errno == ELOOP || errno == store::kNotRegular))
    return std::nullopt;
  if (!file) store::throw_file_error(folder.claim(), "read", errno);
  for (int i = 0; i < kTries && is_locked(file.get()); ++i) {
    const auto found = read_claim(file.get());
    const auto times = found ? times_of(found->process) : std::nullopt;
    if (times && times->start == found->start_time) return found;
    std::this_thread::sleep_for(kBetweenTries);
  }
  return std::nullopt;
}

std::optional<ProcessTimes> times_of(pid_t process) {
  const std::filesystem::path path = "/proc/" + std::to_string(process) + "/stat";
  errno = 0;
  std::ifstream file(path);
  std::string line;
  if (!file && (errno == EMFILE || errno == ENFILE || errno == ENOMEM)) store::throw_file_error(path, "read", errno);
  if (!std::getline(file, line)) return std::nullopt;
  // The fields follow the name, which is in parentheses and may contain anything. They count from 1 (proc(5)).
  constexpr int kUserTime = 14;
  constexpr int kSystemTime = 15;
  constexpr int kStartTime = 22;
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  std::string field;
  ProcessTimes out;
  for (int i = 3; i <= kStartTime && fields >> field; ++i) {
    if (i == kUserTime || i == kSystemTime) out.used += std::stoull(field);
    if (i == kStartTime) out.start = std::stoull(field);
  }
  return out;
}

std::int64_t peak_memory_of(pid_t process) {
  constexpr std::int64_t kKibibyte = 1024;
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("VmHWM:")) return kKibibyte * std::strtoll(line.c_str() + 6, nullptr, 10);
  }
  return 0;
}

}  // namespace cellcrush::worker
