#pragma once

namespace cellcrush::worker {

/// Seconds of one core for one step of one element, measured by a short run of a small preset: about 0.05 s,
/// once at the daemon's start. Prediction only; the true cost varies with the section's points, the contacts and the
/// machine's load.
double measure_step_cost();

}  // namespace cellcrush::worker
