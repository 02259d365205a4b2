// daemon_keeper LOG PROGRAM ARGUMENT...: runs a daemon with its output in LOG, and adopts every process below it, also
// those that made a session of their own. Ends when none is left. On SIGTERM, or when its parent dies, kills them all.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

#include "slurm/process_tree.h"

namespace {

sigset_t watched_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGCHLD);
  return signals;
}

[[noreturn]] void become(char* const* command, const char* log, pid_t parent) {
  const sigset_t signals = watched_signals();
  sigprocmask(SIG_UNBLOCK, &signals, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  const int output = open(log, O_WRONLY | O_CREAT | O_APPEND, 0600);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(command[0], command);
  std::perror(command[0]);
  _exit(127);
}

// Reaps what has ended; whether a child is left.
bool has_children() {
  pid_t ended = 0;
  while ((ended = waitpid(-1, nullptr, WNOHANG)) > 0) {
  }
  return ended == 0 || errno != ECHILD;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    std::fputs("usage: daemon_keeper LOG PROGRAM ARGUMENT...\n", stderr);
    return 2;
  }
  const sigset_t signals = watched_signals();
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t self = getpid();
  const pid_t daemon = fork();
  if (daemon < 0) {
    std::perror("fork");
    return 1;
  }
  if (daemon == 0) become(arguments + 2, arguments[1], self);
  bool ends = false;
  while (has_children()) {
    // The children of a process that is killed become children of this one.
    if (ends) {
      for (const pid_t child : cellcrush::testing::children_of(self)) kill(child, SIGKILL);
    }
    const timespec pause{0, 10'000'000};
    if ((ends ? sigtimedwait(&signals, nullptr, &pause) : sigwaitinfo(&signals, nullptr)) == SIGTERM) ends = true;
  }
  return 0;
}
