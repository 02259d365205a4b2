#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "store/job_folder.h"
#include "store/report.pb.h"
#include "translate/results.h"

namespace cellcrush {
struct Scene;
}

namespace cellcrush::worker {

/// The scene of the order's case. Throws std::runtime_error if this version rejects the case.
std::shared_ptr<const Scene> scene_of(const Order& order);

/// The origin of the bits that a run of this order produces here.
Checkpoint::Origin origin_of(const Order& order);

/// The first origin that differs from `origin` among earlier workers in the folder.
std::optional<Checkpoint::Origin> find_other_origin(const store::JobFolder& folder, const Checkpoint::Origin& origin);

/// Passes the bytes of Checkpoint.simulation on, the same in every call.
using SimulationBytes = std::function<void(const ByteSink&)>;

/// Makes a checkpoint durable under a temporary name, then renames it; the previous one is kept. A complete checkpoint
/// remains whenever the process is killed. `checkpoint` is without the simulation, whose bytes are written in pieces,
/// so that none of them is in memory twice. Throws ServiceError: storage_full or internal.
void write_checkpoint(const store::JobFolder& folder, const Checkpoint& checkpoint, const SimulationBytes& simulation);

/// Result of find_checkpoint.
struct FoundCheckpoint {
  std::optional<Checkpoint> checkpoint;  ///< the newest usable one, without its simulation
  ByteSource simulation;                 ///< the bytes of its simulation, read from the file in pieces, once
  std::vector<std::string> refused;      ///< why newer ones are not usable, one sentence each
};

/// The newest checkpoint that is complete and of the same solver, processor kind and case.
FoundCheckpoint find_checkpoint(const store::JobFolder& folder, const Checkpoint::Origin& origin);

/// Processor time of the run up to the checkpoint.
translate::RunTime run_time_of(const Checkpoint& checkpoint);

}  // namespace cellcrush::worker
