#pragma once

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/job.pb.h"

namespace cellcrush::testing {

/// A few cells at 100 m/s, crushed to half their length: done in a fraction of a second.
v1::Case small_case();

/// A job of it.
v1::Job small_job();

/// Fewer cells, to three tenths, with 20 samples: a worker's start takes as long.
v1::Case tiny_case();

/// A small crush that takes some seconds, with 200 samples and 20 frames: 25,000 steps, a multiple of both.
v1::Case case_of_seconds();

/// So slow a crush of so many cells that it does not end during a test.
v1::Case endless_case();

}  // namespace cellcrush::testing
