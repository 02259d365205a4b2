#pragma once

namespace cellcrush::worker {

/// Descriptor at which a worker process finds its socket.
inline constexpr int kSocket = 3;

/// The whole of a worker process: reads its Order from kSocket, runs the job and reports. `daemon`: process that
/// started it; the worker ends with it. Does not return: the process ends with 0 after a final report, otherwise with
/// 3.
[[noreturn]] void worker_main(int daemon);

}  // namespace cellcrush::worker
