#include "programs/process.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

namespace cellcrush::e2e {
namespace {

using Clock = std::chrono::steady_clock;

std::pair<int, int> make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
  return {ends[0], ends[1]};
}

// Only calls that are allowed between fork and exec.
[[noreturn]] void become(char* const* arguments, pid_t parent, int input, int output, int errors) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  execv(arguments[0], arguments);
  _exit(127);
}

// Appends what the pipe holds; closes it at its end.
void drain(int& pipe, std::string& text) {
  std::array<char, 65536> buffer{};
  const ssize_t count = read(pipe, buffer.data(), buffer.size());
  if (count > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  } else if (count == 0 || errno != EINTR) {
    close(std::exchange(pipe, -1));
  }
}

}  // namespace

Process::Process(const std::vector<std::string>& command, const std::string& input, int columns)
    : start_(Clock::now()) {
  std::vector<std::string> copy = command;
  std::vector<char*> arguments;
  arguments.reserve(copy.size() + 1);
  for (std::string& argument : copy) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  if (columns > 0) {
    const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
    id_ = forkpty(&output_pipe_, nullptr, nullptr, &size);
    if (id_ == 0) become(arguments.data(), parent, STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO);
    if (id_ < 0) throw std::system_error(errno, std::generic_category(), "forkpty");
    return;
  }
  const auto [input_read, input_write] = make_pipe();
  const auto [output_read, output_write] = make_pipe();
  const auto [error_read, error_write] = make_pipe();
  // A daemon whose log nobody reads yet must not stand still.
  fcntl(error_write, F_SETPIPE_SZ, 1 << 20);
  id_ = fork();
  if (id_ == 0) become(arguments.data(), parent, input_read, output_write, error_write);
  if (id_ > 0) setpgid(id_, id_);
  [[maybe_unused]] const ssize_t written = write(input_write, input.data(), input.size());
  for (const int end : {input_read, input_write, output_write, error_write}) close(end);
  output_pipe_ = output_read;
  error_pipe_ = error_read;
  if (id_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
}

Process::~Process() {
  if (id_ > 0) {
    kill(-id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  if (output_pipe_ >= 0) close(output_pipe_);
  if (error_pipe_ >= 0) close(error_pipe_);
}

void Process::send(int signal) const {
  if (id_ > 0) kill(id_, signal);
}

void Process::type(const std::string& text) const {
  if (write(output_pipe_, text.data(), text.size()) < 0)
    throw std::system_error(errno, std::generic_category(), "type");
}

// Waits for output on either pipe; false when both are closed or the deadline has passed.
bool Process::read_some(Clock::time_point deadline) {
  if (output_pipe_ < 0 && error_pipe_ < 0) return false;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  if (left <= 0) return false;
  std::array<pollfd, 2> pipes{pollfd{output_pipe_, POLLIN, 0}, pollfd{error_pipe_, POLLIN, 0}};
  if (poll(pipes.data(), pipes.size(), static_cast<int>(std::min<long>(left, 1'000'000))) < 0) return errno == EINTR;
  if (pipes[0].revents != 0) drain(output_pipe_, output_);
  if (pipes[1].revents != 0) drain(error_pipe_, errors_);
  return true;
}

bool Process::wait_for_output(const std::string& text, std::chrono::milliseconds limit) {
  return read_until([&] { return output_.find(text) != std::string::npos; }, limit);
}

bool Process::read_until(const std::function<bool()>& condition, std::chrono::milliseconds limit) {
  const auto deadline = Clock::now() + limit;
  while (!condition()) {
    if (!read_some(deadline)) return false;
  }
  return true;
}

Outcome Process::wait(std::chrono::milliseconds limit) {
  const auto deadline = Clock::now() + limit;
  while (read_some(deadline)) {
  }
  Outcome outcome;
  int status = 0;
  // Both pipes are closed, or the time is up; a program that closes its output early may still run.
  while (waitpid(id_, &status, WNOHANG) == 0) {
    if (Clock::now() >= deadline) {
      outcome.timed_out = true;
      kill(-id_, SIGKILL);
      waitpid(id_, &status, 0);
      break;
    }
    poll(nullptr, 0, 5);
  }
  id_ = -1;
  if (!outcome.timed_out) outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.output = output_;
  outcome.errors = errors_;
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  return outcome;
}

Outcome run(const std::vector<std::string>& command, std::chrono::milliseconds limit) {
  return Process(command).wait(limit);
}

}  // namespace cellcrush::e2e
