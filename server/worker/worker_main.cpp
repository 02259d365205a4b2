#include "worker/worker_main.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>

#include "worker/report_stream.h"
#include "worker/run_case.h"

namespace cellcrush::worker {
namespace {

constexpr int kNoReport = 3;

}  // namespace

void worker_main(int daemon) {
  // From here on the kernel ends this process with the daemon; if the daemon is gone already, it is too late for that.
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != daemon) _exit(kNoReport);
  ReportStream stream(kSocket);
  Order order;
  if (stream.read(order) != ReportStream::Read::message) _exit(kNoReport);
  const auto final = run_case(
      order, [&stream](const Report& report) { return stream.write(report); }, [&stream] { return stream.at_end(); });
  if (!final) _exit(kNoReport);
  Report report;
  *report.mutable_final() = *final;
  // _exit: the result is closed and durable, and nothing that runs at exit may turn a success into a crash.
  _exit(stream.write(report) ? 0 : kNoReport);
}

}  // namespace cellcrush::worker
