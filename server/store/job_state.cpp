#include "store/job_state.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cellcrush::store {
namespace {

using Step = std::pair<v1::JobState, v1::JobState>;

// All allowed transitions.
constexpr std::array<Step, 15> kSteps = {{
    {v1::PENDING, v1::RUNNING},
    {v1::PENDING, v1::CANCELLED},
    {v1::PENDING, v1::SUSPENDED},
    {v1::PENDING, v1::FAILED},  // no worker could be started
    {v1::RUNNING, v1::SUCCEEDED},
    {v1::RUNNING, v1::FAILED},
    {v1::RUNNING, v1::SUSPENDED},
    {v1::RUNNING, v1::PENDING},  // the worker was lost, or the daemon ended
    {v1::RUNNING, v1::CANCELLING},
    {v1::SUSPENDED, v1::PENDING},
    {v1::SUSPENDED, v1::CANCELLED},
    {v1::SUSPENDED, v1::FAILED},
    {v1::CANCELLING, v1::CANCELLED},
    {v1::CANCELLING, v1::SUCCEEDED},  // the run ended before the request reached it
    {v1::CANCELLING, v1::FAILED},
}};

}  // namespace

bool may_follow(v1::JobState from, v1::JobState to) {
  return std::find(kSteps.begin(), kSteps.end(), Step{from, to}) != kSteps.end();
}

bool is_terminal(v1::JobState state) { return state == v1::SUCCEEDED || state == v1::FAILED || state == v1::CANCELLED; }

}  // namespace cellcrush::store
