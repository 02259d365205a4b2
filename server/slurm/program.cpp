#include "slurm/program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "jobs/worker_process.h"

namespace cellcrush::slurm {
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

}  // namespace

ProgramEnd run_program(const std::vector<std::string>& command, std::chrono::milliseconds limit,
                       const std::stop_token& stop) {
  Pipe output;
  Pipe errors;
  ProgramEnd out;
  const auto end = Clock::now() + limit;
  pid_t process = 0;
  if (const int error = jobs::start_process(command, {}, output.writing(), errors.writing(), process); error != 0)
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

}  // namespace cellcrush::slurm
