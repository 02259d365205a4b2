#pragma once

namespace cellcrush::worker {

/// Seconds of one core per step and element, measured by a short run of a small preset: about 0.05 s, once at the start
/// of the daemon. For predictions only: the actual cost varies with section points, contacts and load.
double measure_step_cost();

}  // namespace cellcrush::worker
