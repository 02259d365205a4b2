#include "jobs/local_process.h"

#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "jobs/cancellation.h"
#include "jobs/child.h"
#include "worker/report_stream.h"
#include "worker/worker_main.h"

namespace cellcrush::jobs {
namespace {

// A descriptor that closes itself and is not inherited.
class OwnedFile {
 public:
  explicit OwnedFile(int value) : value_(value) {}
  ~OwnedFile() { reset(); }
  OwnedFile(const OwnedFile&) = delete;
  OwnedFile& operator=(const OwnedFile&) = delete;

  [[nodiscard]] int get() const { return value_; }
  void reset() {
    if (value_ >= 0) close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

// Starts the program with `socket` at worker::kSocket, and no other descriptors but the standard three. Returns 0 or an
// errno.
int spawn(const std::filesystem::path& program, int socket, pid_t& pid) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, socket, worker::kSocket);
  posix_spawn_file_actions_addclosefrom_np(&actions, worker::kSocket + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  // A group of its own: Ctrl-C at the daemon's terminal is the daemon's to handle.
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);

  std::string name = program.string();
  std::string command = "worker";
  std::string option = "--daemon";
  std::string daemon = std::to_string(getpid());
  std::array<char*, 5> arguments = {name.data(), command.data(), option.data(), daemon.data(), nullptr};
  const int error = posix_spawn(&pid, name.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

WorkerExit not_started(int error) {
  WorkerExit out;
  out.kind = WorkerExit::Kind::not_started;
  out.reason = std::generic_category().message(error);
  return out;
}

// Passes reports on until the worker says no more. False when what it said is no report.
bool pass_on_reports(worker::ReportStream& stream, const WorkerEvents& events, Cancellation& cancellation,
                     WorkerExit& out) {
  while (true) {
    worker::Report report;
    switch (stream.read(report)) {
      case worker::ReportStream::Read::end: return true;
      case worker::ReportStream::Read::broken: return false;
      case worker::ReportStream::Read::message: break;
    }
    if (report.has_final()) {
      out.final = report.final();
    } else if (report.has_stopping()) {
      cancellation.acknowledged();
    } else {
      events.reported(report);
    }
  }
}

}  // namespace

WorkerExit LocalProcess::run(const worker::Order& order, const WorkerEvents& events,
                             const Interruptions& interruptions) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return not_started(errno);
  const OwnedFile socket(ends[0]);
  OwnedFile of_worker(ends[1]);
  pid_t pid = 0;
  if (const int error = spawn(program_, of_worker.get(), pid); error != 0) return not_started(error);
  Child child(pid);
  of_worker.reset();
  events.started(pid);

  WorkerExit out;
  bool sound = true;
  {
    // A daemon that ends breaks the conversation off, wherever it is.
    const std::stop_callback hang_up(interruptions.stop, [&socket] { shutdown(socket.get(), SHUT_RDWR); });
    worker::ReportStream stream(socket.get());
    // When this fails the worker is gone, and reading tells the same.
    stream.write(order);
    Cancellation cancellation(socket.get(), child, interruptions.cancel);
    sound = pass_on_reports(stream, events, cancellation, out);
  }
  const bool cancelled = interruptions.cancel.stop_requested();
  if (!sound || interruptions.stop.stop_requested()) {
    child.end();
    out.kind = !sound ? WorkerExit::Kind::broken : cancelled ? WorkerExit::Kind::cancelled : WorkerExit::Kind::stopped;
    return out;
  }
  const int status = child.let_end();
  out.kind = cancelled             ? WorkerExit::Kind::cancelled
             : WIFSIGNALED(status) ? WorkerExit::Kind::signalled
                                   : WorkerExit::Kind::exited;
  out.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  return out;
}

}  // namespace cellcrush::jobs
