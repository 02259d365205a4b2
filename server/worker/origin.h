#pragma once

#include <optional>

#include "store/job_folder.h"
#include "worker/report.pb.h"

namespace cellcrush::worker {

/// Whose bits a run of the order makes, here and now.
Checkpoint::Origin origin_of(const Order& order);

/// Of an earlier worker in the folder whose bits are others than `origin`'s, the first one.
std::optional<Checkpoint::Origin> find_other_origin(const store::JobFolder& folder, const Checkpoint::Origin& origin);

}  // namespace cellcrush::worker
