#pragma once

#include <optional>

#include "store/job_folder.h"
#include "worker/report.pb.h"

namespace cellcrush::worker {

/// The origin of the bits that a run of this order produces here.
Checkpoint::Origin origin_of(const Order& order);

/// The first origin that differs from `origin` among earlier workers in the folder.
std::optional<Checkpoint::Origin> find_other_origin(const store::JobFolder& folder, const Checkpoint::Origin& origin);

}  // namespace cellcrush::worker
