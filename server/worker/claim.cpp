#include "worker/claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace cellcrush::worker {
namespace {

// Whoever looks whether the folder is claimed holds the lock for an instant; a worker that begins writes its number soon.
constexpr int kTries = 100;
constexpr std::chrono::milliseconds kBetweenTries{10};

bool is_locked(int file) {
  if (flock(file, LOCK_SH | LOCK_NB) != 0) return errno == EWOULDBLOCK;
  flock(file, LOCK_UN);
  return false;
}

std::optional<Claim> read_claim(const JobFolder& folder) {
  std::ifstream file(folder.claim());
  Claim out;
  if (file >> out.process >> out.start_time) return out;
  return std::nullopt;
}

}  // namespace

bool claim(const JobFolder& folder) {
  const int file = open(folder.claim().c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return false;
  for (int i = 0; flock(file, LOCK_EX | LOCK_NB) != 0; ++i) {
    if (i == kTries) return false;
    std::this_thread::sleep_for(kBetweenTries);
  }
  const auto times = times_of(getpid());
  const std::string text = std::to_string(getpid()) + " " + std::to_string(times ? times->start : 0) + "\n";
  // The file stays open, and locked, for as long as the process lives.
  return ftruncate(file, 0) == 0 && pwrite(file, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
}

std::optional<Claim> find_claim(const JobFolder& folder) {
  const int file = open(folder.claim().c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  std::optional<Claim> out;
  for (int i = 0; i < kTries && is_locked(file); ++i) {
    const auto found = read_claim(folder);
    const auto times = found ? times_of(found->process) : std::nullopt;
    if (times && times->start == found->start_time) {
      out = found;
      break;
    }
    std::this_thread::sleep_for(kBetweenTries);
  }
  close(file);
  return out;
}

std::optional<ProcessTimes> times_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  // Behind the name, which stands in parentheses and may hold anything; fields are counted from 1 (proc(5)).
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

}  // namespace cellcrush::worker
