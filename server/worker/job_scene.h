#pragma once

#include <memory>

#include "worker/report.pb.h"

namespace cellcrush {
struct Scene;
}

namespace cellcrush::worker {

/// The scene that the order's case describes. Throws std::runtime_error when the case is no longer accepted.
std::shared_ptr<const Scene> scene_of(const Order& order);

}  // namespace cellcrush::worker
