#pragma once

#include "cellcrush/v1/job.pb.h"

namespace cellcrush::store {

/// Whether a job may change from state `from` to state `to`.
bool may_follow(v1::Job::State from, v1::Job::State to);

/// Whether the state is final.
bool is_terminal(v1::Job::State state);

}  // namespace cellcrush::store
