#include "store/job_state.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cellcrush::store {
namespace {

using Step = std::pair<v1::Job::State, v1::Job::State>;

// All allowed transitions.
constexpr std::array<Step, 15> kSteps = {{
    {v1::Job::PENDING, v1::Job::RUNNING},
    {v1::Job::PENDING, v1::Job::CANCELLED},
    {v1::Job::PENDING, v1::Job::SUSPENDED},
    {v1::Job::PENDING, v1::Job::FAILED},  // no worker could be started
    {v1::Job::RUNNING, v1::Job::SUCCEEDED},
    {v1::Job::RUNNING, v1::Job::FAILED},
    {v1::Job::RUNNING, v1::Job::SUSPENDED},
    {v1::Job::RUNNING, v1::Job::PENDING},  // the worker was lost, or the daemon ended
    {v1::Job::RUNNING, v1::Job::CANCELLING},
    {v1::Job::SUSPENDED, v1::Job::PENDING},
    {v1::Job::SUSPENDED, v1::Job::CANCELLED},
    {v1::Job::SUSPENDED, v1::Job::FAILED},
    {v1::Job::CANCELLING, v1::Job::CANCELLED},
    {v1::Job::CANCELLING, v1::Job::SUCCEEDED},  // the run ended before the request reached it
    {v1::Job::CANCELLING, v1::Job::FAILED},
}};

}  // namespace

bool may_follow(v1::Job::State from, v1::Job::State to) {
  return std::find(kSteps.begin(), kSteps.end(), Step{from, to}) != kSteps.end();
}

bool is_terminal(v1::Job::State state) {
  return state == v1::Job::SUCCEEDED || state == v1::Job::FAILED || state == v1::Job::CANCELLED;
}

}  // namespace cellcrush::store
