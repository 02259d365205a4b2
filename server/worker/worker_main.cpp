#include "worker/worker_main.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <utility>

#include "store/durable_file.h"
#include "worker/claim.h"
#include "worker/run_job.h"

namespace cellcrush::worker {
namespace {

constexpr int kFolder = O_RDONLY | O_DIRECTORY;

// The signals stay blocked; a pending one is visible to all threads.
StopRequest pending_request() {
  sigset_t pending;
  sigpending(&pending);
  if (sigismember(&pending, kCancelSignal) == 1) return StopRequest::cancel;
  return sigismember(&pending, kSuspendSignal) == 1 ? StopRequest::suspend : StopRequest::none;
}

int run(const store::JobFolder& job) {
  try {
    if (!claim(job)) return kFolderIsClaimed;
    Order order;
    const OpenFile file = store::open_own(job.order(), O_RDONLY, "read");
    if (!order.ParseFromFileDescriptor(file.get())) return kNoReport;
    run_job(job, std::move(order), pending_request);
    return kReported;
  } catch (const std::exception& error) {
    return exit_code_of(error);
  }
}

}  // namespace

int exit_code_of(const std::exception& error) {
  const Shortage shortage = trouble_of(error).shortage;
  return shortage == Shortage::none ? kNoReport : kShortage + static_cast<int>(shortage);
}

Shortage shortage_of_exit_code(int code) {
  for (const Shortage shortage : kShortages) {
    if (code == kShortage + static_cast<int>(shortage)) return shortage;
  }
  return Shortage::none;
}

void worker_main(const std::filesystem::path& folder, pid_t parent) {
  if (parent != 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(kNoReport);
  }
  // When the kernel must end a process for lack of memory, rather this one than the daemon.
  std::ofstream("/proc/self/oom_score_adj") << 500;
  // Runs inside the folder, wherever that is moved: after a restore the path may belong to another job.
  const OpenFile own = store::try_open_own(store::canonical_of(folder.parent_path()) / folder.filename(), kFolder);
  if (!own || fchdir(own.get()) != 0) _exit(kNoReport);
  // _exit: the result is closed and durable, and exit handlers must not turn success into a crash.
  _exit(run(store::JobFolder(".")));
}

}  // namespace cellcrush::worker
