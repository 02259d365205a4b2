#pragma once

#include <memory>

#include "worker/report.pb.h"

namespace cellcrush {
struct Scene;
}

namespace cellcrush::worker {

/// The scene of the order's case. Throws std::runtime_error if this version rejects the case.
std::shared_ptr<const Scene> scene_of(const Order& order);

}  // namespace cellcrush::worker
