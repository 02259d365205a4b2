#include "program.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace cellcrush::client::testing {

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

[[noreturn]] void run_child(const std::vector<std::string>& arguments) {
  std::vector<char*> words = {const_cast<char*>(CELLCRUSH_PROGRAM)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  setenv("LC_ALL", "C.UTF-8", 1);
  setenv("TERM", "xterm", 1);
  unsetenv("NO_COLOR");
  for (const char* name : {"CELLCRUSH_SERVER", "CELLCRUSH_TLS_CA", "CELLCRUSH_TOKEN_FILE", "CELLCRUSH_TOKEN"})
    unsetenv(name);
  execv(CELLCRUSH_PROGRAM, words.data());
  _exit(127);
}

// Moves what can be read into `text`; false at the end.
bool drain(int& descriptor, std::string& text) {
  std::array<char, 65536> buffer{};
  const ssize_t count = read(descriptor, buffer.data(), buffer.size());
  if (count > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
    return true;
  }
  close(descriptor);
  descriptor = -1;
  return false;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, int columns, const std::string& input) : started_(now()) {
  std::array<int, 2> in{};
  std::array<int, 2> out{};
  std::array<int, 2> err{};
  if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  if (columns > 0) {
    winsize size{24, static_cast<unsigned short>(columns), 0, 0};
    process_ = forkpty(&output_, nullptr, nullptr, &size);
    if (process_ == 0) run_child(arguments);
    for (const int end : {out[0], out[1], err[0], err[1], in[0]}) close(end);
  } else {
    process_ = fork();
    if (process_ == 0) {
      dup2(in[0], STDIN_FILENO);
      dup2(out[1], STDOUT_FILENO);
      dup2(err[1], STDERR_FILENO);
      run_child(arguments);
    }
    for (const int end : {out[1], err[1], in[0]}) close(end);
    output_ = out[0];
    errors_ = err[0];
    [[maybe_unused]] const ssize_t written = write(in[1], input.data(), input.size());
  }
  close(in[1]);
  if (process_ < 0) throw std::runtime_error("the program does not start");
}

Program::~Program() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  if (output_ >= 0) close(output_);
  if (errors_ >= 0) close(errors_);
}

bool Program::read_some(int milliseconds) {
  std::array<pollfd, 2> ends = {{{output_, POLLIN, 0}, {errors_, POLLIN, 0}}};
  if (poll(ends.data(), ends.size(), milliseconds) <= 0) return output_ >= 0 || errors_ >= 0;
  if (output_ >= 0 && ends[0].revents != 0) drain(output_, result_.output);
  if (errors_ >= 0 && ends[1].revents != 0) drain(errors_, result_.errors);
  return output_ >= 0 || errors_ >= 0;
}

bool Program::wait_for_output(const std::string& text) {
  const double end = now() + 10.0;
  while (now() < end) {
    if (result_.output.find(text) != std::string::npos) return true;
    if (!read_some(50)) return result_.output.find(text) != std::string::npos;
  }
  return false;
}

void Program::type(const std::string& text) const {
  if (write(output_, text.data(), text.size()) < 0) throw std::runtime_error("the terminal takes no text");
}

void Program::interrupt() const { kill(process_, SIGINT); }

ProgramResult Program::wait() {
  const double end = started_ + 30.0;
  while (now() < end && read_some(50)) {
  }
  int status = 0;
  pid_t ended = 0;
  while (now() < end && ended == 0) {
    ended = waitpid(process_, &status, WNOHANG);
    if (ended == 0) usleep(5000);
  }
  result_.seconds = now() - started_;
  if (ended != process_) return result_;
  process_ = -1;
  if (WIFEXITED(status)) result_.exit_code = WEXITSTATUS(status);
  return result_;
}

ProgramResult run_program(const std::vector<std::string>& arguments, const std::string& input) {
  return Program(arguments, 0, input).wait();
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace cellcrush::client::testing
