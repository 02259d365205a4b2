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
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "command_error.h"

// glibc 2.36 declares these without C linkage.
extern "C" {
#include <sys/pidfd.h>
}

namespace cellcrush::client {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{60};
constexpr std::string_view kSaidBy = "cellcrushd: ";

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

// Without the last line feed.
std::string text_of(const fs::path& log) {
  std::ifstream file(log);
  std::string out{std::istreambuf_iterator<char>(file), {}};
  if (out.ends_with('\n')) out.pop_back();
  return out;
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

// A running program with the reading end of its standard output; -1 for none.
struct Started {
  pid_t process = -1;
  int output = -1;
  int error = 0;  ///< an errno, if it does not run
};

Started start(std::vector<std::string>& words, const fs::path& log) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::array<int, 2> output{-1, -1};
  const int log_file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const bool is_ready = log_file >= 0 && pipe2(output.data(), O_CLOEXEC) == 0;
  const pid_t parent = getpid();
  Started out;
  if (is_ready) out.process = fork();
  if (out.process == 0) become(pointers.data(), parent, output[1], log_file);
  out.error = errno;
  out.output = output[0];
  for (const int file : {log_file, output[1]}) {
    if (file >= 0) close(file);
  }
  return out;
}

std::string why_not_started(const std::string& program, const Started& started, const fs::path& log) {
  std::string why = started.process > 0 ? last_line_of(log) : std::strerror(started.error);
  if (why.empty()) why = "it cannot be run. Install it beside cellcrush or in a folder of $PATH.";
  return program + " does not start: " + why;
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
  serve(data, time_limit_s);
}

PrivateDaemon::PrivateDaemon(const std::vector<std::string>& results) : folder_(make_socket_folder()) {
  log_ = folder_ / "daemon.log";
  const fs::path data = folder_ / "data";
  if (!results.empty()) import(data, results);
  serve(data, 0.0);
}

void PrivateDaemon::import(const fs::path& data, const std::vector<std::string>& results) {
  std::vector<std::string> words = {daemon_program(), "import", "--data", data.string(), "--link"};
  words.insert(words.end(), results.begin(), results.end());
  const Started started = start(words, log_);
  int status = -1;
  while (started.process > 0 && waitpid(started.process, &status, 0) < 0 && errno == EINTR) continue;
  if (started.output >= 0) close(started.output);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::string why = text_of(log_);
  if (why.starts_with(kSaidBy)) why.erase(0, kSaidBy.size());
  remove_folder();
  refuse(why.empty() ? why_not_started(words[0], started, log_) : why);
}

void PrivateDaemon::serve(const fs::path& data, double time_limit_s) {
  // As many workers as cores, since a job may use the cores that no other job waits for.
  std::vector<std::string> words = {daemon_program(), "--data", data.string(), "--listen", address(), "--http", "none"};
  if (time_limit_s > 0.0) words.insert(words.end(), {"--max-job-time", fmt::format("{}", time_limit_s)});
  const Started started = start(words, log_);
  pid_ = started.process;
  const bool serves = pid_ > 0 && wait_until_it_listens(started.output);
  if (started.output >= 0) close(started.output);
  if (serves) return;
  const std::string why = why_not_started(words[0], started, log_);
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  remove_folder();
  refuse(why);
}

void PrivateDaemon::remove_folder() {
  std::error_code none;
  fs::remove_all(folder_, none);
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
  remove_folder();
  return true;
}

void PrivateDaemon::stop() {
  if (pid_ < 0) return;
  const int process = pidfd_open(pid_, 0);
  kill(pid_, SIGTERM);
  const auto limit = Clock::now() + kPatience;
  while (!has_ended()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(limit - Clock::now());
    pollfd end{process, POLLIN, 0};
    if (left.count() > 0) {
      poll(&end, 1, static_cast<int>(left.count()));
      continue;
    }
    close(process);
    refuse(
        fmt::format("cellcrushd (process {}) did not exit within {} s. End it with "
                    "`kill {}` before you continue.",
                    pid_, kPatience.count(), pid_));
  }
  close(process);
}

}  // namespace cellcrush::client
