#pragma once

#include <memory>
#include <optional>

#include "store/job_folder.h"
#include "store/report.pb.h"

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

}  // namespace cellcrush::worker
