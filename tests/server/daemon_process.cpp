#include "server/daemon_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "worker/claim.h"

namespace cellcrush::testing {
namespace {

using Clock = std::chrono::steady_clock;

// Adds what is there to `text`; false at the end.
bool read_some(int file, std::string& text, int wait_ms) {
  pollfd waiting{file, POLLIN, 0};
  if (poll(&waiting, 1, wait_ms) <= 0) return true;
  std::array<char, 4096> buffer{};
  const auto count = read(file, buffer.data(), buffer.size());
  if (count <= 0) return false;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

// State of the process or thread in a folder of /proc: the first letter behind its name, which stands in parentheses.
// 0 when it is gone.
char state_of(const std::string& folder) {
  std::ifstream status(folder + "/stat");
  std::string line;
  std::getline(status, line);
  const auto end = line.rfind(')');
  return end != std::string::npos && end + 2 < line.size() ? line[end + 2] : '\0';
}

// Only calls that are allowed between fork and exec.
[[noreturn]] void become(char* const* arguments, pid_t parent, int output, int errors, int most_descriptors) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto descriptors = static_cast<rlim_t>(most_descriptors);
  const rlimit limit{descriptors, descriptors};
  if (most_descriptors > 0 && setrlimit(RLIMIT_NOFILE, &limit) != 0) _exit(127);
  if (getppid() != parent) _exit(127);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  execv(arguments[0], arguments);
  _exit(127);
}

}  // namespace

DaemonProcess::DaemonProcess(const std::vector<std::string>& arguments, int most_descriptors) {
  std::array<int, 2> out{};
  std::array<int, 2> error{};
  if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(error.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  // Nobody reads the log before wait; a daemon that fills the pipe would stand still.
  fcntl(error[1], F_SETPIPE_SZ, 1 << 20);
  std::vector<std::string> words = {CELLCRUSHD_PROGRAM};
  if (std::find(arguments.begin(), arguments.end(), "--http") == arguments.end())
    words.insert(words.end(), {"--http", "none"});
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(pointers.data(), parent, out[1], error[1], most_descriptors);
  close(out[1]);
  close(error[1]);
  output_ = out[0];
  error_output_ = error[0];
  if (pid_ < 0) throw std::runtime_error("cellcrushd cannot be started");
}

DaemonProcess::~DaemonProcess() {
  if (pid_ > 0) {
    send_signal(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(output_);
  close(error_output_);
}

std::vector<std::string> DaemonProcess::wait_for_addresses(std::size_t count) {
  const std::string prefix = "cellcrushd is listening on ";
  const auto limit = Clock::now() + std::chrono::seconds(30);
  std::vector<std::string> addresses;
  bool open = true;
  while (open && addresses.size() < count && Clock::now() < limit) {
    open = read_some(output_, text_, 100);
    for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
      if (text_.starts_with(prefix)) addresses.push_back(text_.substr(prefix.size(), end - prefix.size()));
      text_.erase(0, end + 1);
    }
  }
  return addresses;
}

std::size_t DaemonProcess::resident_bytes() const {
  std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
  std::string word;
  std::size_t kibibytes = 0;
  while (status >> word) {
    if (word == "VmRSS:" && status >> kibibytes) break;
  }
  return kibibytes * 1024;
}

void DaemonProcess::send_signal(int number) const { kill(pid_, number); }

bool DaemonProcess::wait_for_error(const std::string& words) {
  const auto limit = Clock::now() + std::chrono::seconds(20);
  bool open = true;
  while (open && errors_.find(words) == std::string::npos && Clock::now() < limit)
    open = read_some(error_output_, errors_, 100);
  return errors_.find(words) != std::string::npos;
}

int DaemonProcess::wait() {
  const auto limit = Clock::now() + std::chrono::seconds(20);
  bool open = true;
  while (open && Clock::now() < limit) open = read_some(error_output_, errors_, 100);
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(pid_, &status, WNOHANG)) == 0 && Clock::now() < limit)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (ended == 0) {
    send_signal(SIGKILL);
    waitpid(pid_, &status, 0);
  }
  pid_ = -1;
  return WIFSIGNALED(status) ? -1 - WTERMSIG(status) : WEXITSTATUS(status);
}

bool is_alive(pid_t process) {
  const char state = state_of("/proc/" + std::to_string(process));
  return state != '\0' && state != 'Z';
}

bool is_asleep(pid_t thread) { return state_of("/proc/self/task/" + std::to_string(thread)) == 'S'; }

void kill_workers(const std::filesystem::path& data_folder) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(data_folder / "jobs", none)) {
    if (const auto claimed = worker::find_claim(store::JobFolder(entry.path()))) kill(claimed->process, SIGKILL);
  }
}

bool wait_until_gone(pid_t process, std::chrono::milliseconds limit) {
  const auto end = Clock::now() + limit;
  while (Clock::now() < end) {
    if (!is_alive(process)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return !is_alive(process);
}

}  // namespace cellcrush::testing
