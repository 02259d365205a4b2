#include "worker/worker_main.h"

#include <unistd.h>

#include <fstream>

#include "worker/claim.h"
#include "worker/run_job.h"

namespace cellcrush::worker {
namespace {

// The signals are blocked from the start and stay so; that one waits is seen by all threads.
StopWish pending_wish() {
  sigset_t pending;
  sigpending(&pending);
  if (sigismember(&pending, kCancelSignal) == 1) return StopWish::cancel;
  return sigismember(&pending, kSuspendSignal) == 1 ? StopWish::suspend : StopWish::none;
}

}  // namespace

void worker_main(const std::filesystem::path& folder) {
  const JobFolder job(folder);
  if (!claim(job)) _exit(kFolderIsClaimed);
  Order order;
  std::ifstream file(job.order(), std::ios::binary);
  if (!file || !order.ParseFromIstream(&file)) _exit(kNoReport);
  // _exit: the result is closed and durable, and nothing that runs at exit may turn a success into a crash.
  _exit(run_job(job, order, pending_wish) ? kReported : kNoReport);
}

}  // namespace cellcrush::worker
