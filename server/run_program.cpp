#include "run_program.h"

#include <absl/strings/str_join.h>
#include <absl/strings/str_split.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "jobs/worker_process.h"
#include "log_writer.h"
#include "open_file.h"

namespace cellcrush {
namespace {

constexpr std::size_t kMostOutput = std::size_t{64} << 20;
// A process that left the group may hold the pipes open after the program has ended.
constexpr std::chrono::milliseconds kForTheRest{200};

using Clock = std::chrono::steady_clock;

// A pipe whose reading end does not block.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "No pipe");
    fcntl(ends_[0], F_SETFL, O_NONBLOCK);
  }
  ~Pipe() {
    close_writing();
    close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  [[nodiscard]] int reading() const { return ends_[0]; }
  [[nodiscard]] int writing() const { return ends_[1]; }
  void close_writing() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

  // False once nobody writes any more.
  bool read_into(std::string& text) const {
    std::array<char, 65536> part{};
    while (true) {
      const auto count = read(ends_[0], part.data(), part.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return errno == EAGAIN;
      if (count == 0) return false;
      if (text.size() < kMostOutput) text.append(part.data(), static_cast<std::size_t>(count));
    }
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

// A file in memory from which a program reads the text; none for no text.
OpenFile file_of(std::string_view text) {
  if (text.empty()) return OpenFile();
  OpenFile out(memfd_create("input", MFD_CLOEXEC));
  if (!out || !write_text(out.get(), text) || lseek(out.get(), 0, SEEK_SET) != 0)
    throw std::system_error(errno, std::generic_category(), "No file for the input");
  return out;
}

}  // namespace

// Several lines as one.
std::string in_one_line(const std::string& text) {
  return absl::StrJoin(absl::StrSplit(text, absl::ByAnyChar(" \n\r\t"), absl::SkipEmpty()), " ");
}

std::string what_failed(const std::string& command, const ProgramEnd& end) {
  const std::string said = in_one_line(end.errors);
  if (end.timed_out) return command + " did not answer in time." + (said.empty() ? "" : " " + said);
  if (!said.empty()) return command + " said: " + said;
  if (end.exit_code) return command + " ended with exit code " + std::to_string(*end.exit_code) + ".";
  return command + " was killed.";
}

ProgramEnd run_program(const std::vector<std::string>& command, std::chrono::milliseconds limit,
                       const std::stop_token& stop, std::string_view input, std::string_view more_input) {
  const OpenFile given = file_of(input);
  const OpenFile more = file_of(more_input);
  Pipe output;
  Pipe errors;
  ProgramEnd out;
  const auto end = Clock::now() + limit;
  pid_t process = 0;
  std::vector<int> streams = {given.get(), output.writing(), errors.writing()};
  if (more) streams.push_back(more.get());
  if (const int error = jobs::start_process(command, {}, streams, process); error != 0)
    throw std::system_error(error, std::generic_category(), command.front() + " cannot be started");
  output.close_writing();
  errors.close_writing();
  std::optional<int> status;
  auto last = end;
  for (bool open = true; (open || !status) && Clock::now() < last && !stop.stop_requested();) {
    std::array<pollfd, 2> waiting = {pollfd{output.reading(), POLLIN, 0}, pollfd{errors.reading(), POLLIN, 0}};
    if (open) {
      poll(waiting.data(), waiting.size(), 20);
    } else {
      usleep(1000);
    }
    const bool more_output = output.read_into(out.output);
    const bool more_errors = errors.read_into(out.errors);
    open = more_output || more_errors;
    int now = 0;
    if (!status && waitpid(process, &now, WNOHANG) == process) {
      status = now;
      last = std::min(end, Clock::now() + kForTheRest);
    }
  }
  if (!status) {
    out.timed_out = true;
    kill(-process, SIGKILL);
    int now = 0;
    while (waitpid(process, &now, 0) < 0 && errno == EINTR) continue;
    return out;
  }
  if (WIFEXITED(*status)) out.exit_code = WEXITSTATUS(*status);
  return out;
}

}  // namespace cellcrush
