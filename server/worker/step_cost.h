#pragma once

namespace cellcrush::worker {

/// Seconds of one core for one step of one element, measured by a short run of a small preset: about 0.1 s,
/// once at the daemon's start. Prediction only; the true cost varies with the contacts and the machine's load.
double measure_step_cost();

}  // namespace cellcrush::worker
