#include "connection/interruption.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

namespace cellcrush::client {

namespace {

// A signal handler may only do what is async-signal-safe: it writes a byte, and the reading end stays readable.
int pipe_ends[2] = {-1, -1};
struct sigaction former_interrupt = {};
struct sigaction former_terminate = {};

extern "C" void on_interrupt(int /*signal*/) {
  const int saved = errno;
  const char byte = 1;
  [[maybe_unused]] const ssize_t written = write(pipe_ends[1], &byte, 1);
  errno = saved;
}

}  // namespace

Interruption::Interruption() {
  if (pipe2(pipe_ends, O_CLOEXEC | O_NONBLOCK) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, &former_interrupt);
  sigaction(SIGTERM, &action, &former_terminate);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &former_interrupt, nullptr);
  sigaction(SIGTERM, &former_terminate, nullptr);
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

bool Interruption::wait_for(std::chrono::milliseconds time) const {
  pollfd reader{pipe_ends[0], POLLIN, 0};
  return poll(&reader, 1, static_cast<int>(time.count())) > 0;
}

}  // namespace cellcrush::client
