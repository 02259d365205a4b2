#pragma once

#include <optional>
#include <string>
#include <vector>

#include "store/job_folder.h"
#include "store/report.pb.h"
#include "translate/results.h"

namespace cellcrush::worker {

/// Makes a checkpoint durable under a temporary name, then renames it; the previous one is kept. A complete checkpoint
/// remains whenever the process is killed. Throws ServiceError: storage_full or internal.
void write_checkpoint(const store::JobFolder& folder, const Checkpoint& checkpoint);

/// Result of find_checkpoint.
struct FoundCheckpoint {
  std::optional<Checkpoint> checkpoint;  ///< the newest usable one
  std::vector<std::string> refused;      ///< why newer ones are not usable, one sentence each
};

/// The newest checkpoint that is complete and of the same solver, processor kind and case.
FoundCheckpoint find_checkpoint(const store::JobFolder& folder, const Checkpoint::Origin& origin);

/// Processor time of the run up to the checkpoint.
translate::RunTime run_time_of(const Checkpoint& checkpoint);

}  // namespace cellcrush::worker
