#include "server/daemon_process.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "worker/claim.h"

namespace cellcrush::testing {
namespace {

// State of the process or thread in a folder of /proc: the first letter behind its name, which stands in parentheses.
// 0 when it is gone.
char state_of(const std::string& folder) {
  std::ifstream status(folder + "/stat");
  std::string line;
  std::getline(status, line);
  const auto end = line.rfind(')');
  return end != std::string::npos && end + 2 < line.size() ? line[end + 2] : '\0';
}

std::vector<std::string> addresses_in(const std::string& output) {
  const std::string prefix = "cellcrushd is listening on ";
  std::vector<std::string> out;
  for (std::size_t begin = 0, end = 0; (end = output.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = output.substr(begin, end - begin);
    if (line.starts_with(prefix)) out.push_back(line.substr(prefix.size()));
  }
  return out;
}

}  // namespace

DaemonProcess::DaemonProcess(const std::vector<std::string>& arguments, int most_descriptors) {
  std::vector<std::string> words;
  if (most_descriptors > 0)
    words = {"/bin/sh", "-c", "ulimit -n " + std::to_string(most_descriptors) + "; exec \"$0\" \"$@\""};
  const char* other = std::getenv("CELLCRUSHD_PROGRAM");
  words.emplace_back(other != nullptr ? other : CELLCRUSHD_PROGRAM);
  if (std::find(arguments.begin(), arguments.end(), "--http") == arguments.end())
    words.insert(words.end(), {"--http", "none"});
  words.insert(words.end(), arguments.begin(), arguments.end());
  process_ = std::make_unique<e2e::Process>(words);
}

std::vector<std::string> DaemonProcess::wait_for_addresses(std::size_t count) {
  process_->read_until([&] { return addresses_in(process_->output()).size() >= count; }, std::chrono::seconds(30));
  return addresses_in(process_->output());
}

std::size_t DaemonProcess::resident_bytes() const {
  std::ifstream status("/proc/" + std::to_string(number()) + "/status");
  std::string word;
  std::size_t kibibytes = 0;
  while (status >> word) {
    if (word == "VmRSS:" && status >> kibibytes) break;
  }
  return kibibytes * 1024;
}

bool DaemonProcess::wait_for_error(const std::string& words) {
  return process_->read_until([&] { return errors().find(words) != std::string::npos; }, std::chrono::seconds(20));
}

int DaemonProcess::wait() {
  const int code = process_->wait(std::chrono::seconds(20)).exit_code;
  return code > 128 ? 127 - code : code;
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
  return wait_until([process] { return !is_alive(process); }, limit);
}

}  // namespace cellcrush::testing
