#pragma once

#include <vector>

#include "cellcrush/v1/event.pb.h"

namespace cellcrush::client::testing {

/// A job of the preset's kind with a title and a speed.
v1::Job make_job(v1::Job::State state);

/// Events of a run to its end in `state`: RUNNING, `samples` samples with progress between them, the end.
std::vector<v1::JobEvent> make_events(int samples, v1::Job::State state);

}  // namespace cellcrush::client::testing
