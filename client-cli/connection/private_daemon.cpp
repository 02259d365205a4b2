#include "connection/private_daemon.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>
#include <vector>

#include "command_error.h"

namespace cellcrush::client {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{60};

// A plain "cellcrushd" is searched in $PATH.
std::string daemon_program() {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).replace_filename("cellcrushd");
  return !error && fs::exists(beside, error) ? beside.string() : "cellcrushd";
}

// In the user's runtime folder, else in /tmp: that folder may be another user's, or its path too long for a socket.
fs::path make_socket_folder() {
  constexpr std::size_t kLongestFolder = 80;
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::string name =
      (runtime == nullptr || *runtime != '/' ? fs::path("/tmp") : fs::path(runtime)) / "cellcrush-XXXXXX";
  if (name.size() <= kLongestFolder && mkdtemp(name.data()) != nullptr) return name;
  name = "/tmp/cellcrush-XXXXXX";
  if (mkdtemp(name.data()) == nullptr) refuse(name + ": cannot be created: " + std::strerror(errno));
  return name;
}

std::string last_line_of(const fs::path& log) {
  std::ifstream file(log);
  std::string line;
  std::string last;
  while (std::getline(file, line)) {
    if (!line.empty()) last = line;
  }
  return last;
}

// Only functions that are allowed between fork and exec.
[[noreturn]] void become(char* const* words, pid_t parent, int output, int log) {
  // A separate process group: Ctrl-C reaches only this program, which then stops the daemon.
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);
  dup2(output, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execvp(words[0], words);
  _exit(127);
}

// Whether the daemon announces that it listens, in its first line, before it ends or the time is up.
bool wait_until_it_listens(int output) {
  const auto limit = Clock::now() + kPatience;
  std::string text;
  std::array<char, 512> buffer{};
  while (Clock::now() < limit) {
    pollfd waiting{output, POLLIN, 0};
    if (poll(&waiting, 1, 100) <= 0) continue;
    const ssize_t count = read(output, buffer.data(), buffer.size());
    if (count <= 0) return false;
    text.append(buffer.data(), static_cast<std::size_t>(count));
    if (text.find('\n') != std::string::npos) return true;
  }
  return false;
}

}  // namespace

PrivateDaemon::PrivateDaemon(const fs::path& data, double time_limit_s)
    : log_(data / "daemon.log"), folder_(make_socket_folder()) {
  // As many workers as cores, since a job may use the cores that no other job waits for.
  std::vector<std::string> words = {daemon_program(), "--data", data.string(), "--listen", address(), "--http", "none"};
  if (time_limit_s > 0.0) words.insert(words.end(), {"--max-job-time", fmt::format("{}", time_limit_s)});
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::array<int, 2> output{-1, -1};
  const int log_file = open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const bool is_ready = log_file >= 0 && pipe2(output.data(), O_CLOEXEC) == 0;
  const pid_t parent = getpid();
  if (is_ready) pid_ = fork();
  if (pid_ == 0) become(pointers.data(), parent, output[1], log_file);
  const int cause = errno;
  for (const int file : {log_file, output[1]}) {
    if (file >= 0) close(file);
  }
  const bool serves = pid_ > 0 && wait_until_it_listens(output[0]);
  if (output[0] >= 0) close(output[0]);
  if (serves) return;
  std::string why = pid_ > 0 ? last_line_of(log_) : std::strerror(cause);
  if (why.empty()) why = "it cannot be run. Install it beside cellcrush or in a folder of $PATH.";
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  static_cast<void>(has_ended());  // removes the socket's folder
  refuse(words[0] + " does not start: " + why);
}

PrivateDaemon::~PrivateDaemon() {
  try {
    stop();
  } catch (const CommandError& error) {
    print_error(error, false);
  }
}

bool PrivateDaemon::has_ended() {
  if (pid_ >= 0 && waitpid(pid_, nullptr, WNOHANG) == 0) return false;
  pid_ = -1;
  std::error_code none;
  fs::remove_all(folder_, none);
  return true;
}

void PrivateDaemon::stop() {
  if (pid_ < 0) return;
  kill(pid_, SIGTERM);
  const auto limit = Clock::now() + kPatience;
  while (!has_ended()) {
    if (Clock::now() > limit) {
      refuse(
          fmt::format("cellcrushd (process {}) did not exit within {} s. End it with "
                      "`kill {}` before you continue.",
                      pid_, kPatience.count(), pid_));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace cellcrush::client
