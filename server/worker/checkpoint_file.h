#pragma once

#include <optional>
#include <string>
#include <vector>

#include "store/job_folder.h"
#include "translate/results.h"
#include "worker/report.pb.h"

namespace cellcrush::worker {

/// Makes a checkpoint durable under a name of its own, then gives it its place; the one that was there is kept as the
/// previous one. Killed at any moment, this leaves one that is whole. Throws ServiceError: storage_full or internal.
void write_checkpoint(const store::JobFolder& folder, const Checkpoint& checkpoint);

/// What find_checkpoint found.
struct FoundCheckpoint {
  std::optional<Checkpoint> checkpoint;  ///< the newest that can be gone on from
  std::vector<std::string> refused;      ///< why newer ones cannot, a sentence each
};

/// The newest checkpoint that is whole and of the same solver, processor kind and case.
FoundCheckpoint find_checkpoint(const store::JobFolder& folder, const Checkpoint::Origin& origin);

/// Processor time of the run until the checkpoint.
translate::RunTime run_time_of(const Checkpoint& checkpoint);

}  // namespace cellcrush::worker
