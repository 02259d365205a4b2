#pragma once

#include <cstdint>

#include "cellcrush/scene_spec.h"

namespace cellcrush::translate {

/// What the memory of a worker depends on.
struct WorkerSize {
  std::int64_t run_bytes = 0;  ///< memory_of_run (cellcrush/run_memory.h)
  std::int64_t elements = 0;
  std::int64_t samples = 0;
};

/// The most resident memory of a worker process, bytes: the program; the run, or what building its scene takes; mesh,
/// samples, frames and the result's buffers; the case. A checkpoint is written in pieces and takes none. Its constants
/// are measured (tests/load/README.md).
std::int64_t memory_of_worker(const SceneSpec& spec, const WorkerSize& size);

/// Bytes that a worker of this predicted memory may allocate: a quarter more, as lists grow by leaps, and room for the
/// stacks of its threads. `factor`: at least 1, after attempts that ran out of memory; beyond 1 the limit does not
/// exceed `most`, unless that is 0.
std::int64_t memory_limit(std::int64_t predicted, int threads, double factor, std::int64_t most);

}  // namespace cellcrush::translate
