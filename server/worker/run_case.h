#pragma once

#include <functional>
#include <optional>

#include "worker/report.pb.h"

namespace cellcrush::worker {

/// Takes a report; false when nobody listens any more.
using Reporter = std::function<bool(const Report&)>;

/// Runs one job from its case to its complete result.h5 and says how it ended: the mesh, then samples, frames and
/// progress are reported on the way, the final report is returned. Never throws on what a case or a disk can do.
/// Nothing is returned when the reporter said that nobody listens.
std::optional<Final> run_case(const Order& order, const Reporter& report);

}  // namespace cellcrush::worker
