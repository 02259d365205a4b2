#pragma once

#include <functional>
#include <optional>

#include "worker/report.pb.h"

namespace cellcrush::worker {

/// Takes a report; false when nobody listens any more.
using Reporter = std::function<bool(const Report&)>;

/// Whether the run is to end early; asked about every 50 ms.
using StopAsked = std::function<bool()>;

/// Runs one job from its case to its complete result.h5 and says how it ended: the mesh, then samples, frames and
/// progress are reported on the way, the final report is returned. A run that is asked to stop takes a last sample and
/// frame and ends like any other, with what there is; one that the solver ends because its result is untrue leaves what
/// was computed before, and the last good frame. Never throws on what a case or a disk can do.
/// Nothing is returned when the reporter said that nobody listens.
std::optional<Final> run_case(const Order& order, const Reporter& report, const StopAsked& stop_asked);

}  // namespace cellcrush::worker
