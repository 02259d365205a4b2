#include "jobs/job_state.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace cellcrush::jobs {
namespace {

using Step = std::pair<v1::JobState, v1::JobState>;

// Every change that there is.
constexpr std::array<Step, 14> kSteps = {{
    {v1::PENDING, v1::RUNNING},
    {v1::PENDING, v1::CANCELLED},
    {v1::PENDING, v1::FAILED},  // no worker could be started
    {v1::RUNNING, v1::SUCCEEDED},
    {v1::RUNNING, v1::FAILED},
    {v1::RUNNING, v1::SUSPENDED},
    {v1::RUNNING, v1::CANCELLING},
    {v1::SUSPENDED, v1::PENDING},
    {v1::SUSPENDED, v1::RUNNING},
    {v1::SUSPENDED, v1::CANCELLED},
    {v1::SUSPENDED, v1::FAILED},
    {v1::CANCELLING, v1::CANCELLED},
    {v1::CANCELLING, v1::SUCCEEDED},  // the run ended before the request reached it
    {v1::CANCELLING, v1::FAILED},
}};

constexpr std::string_view kCollection = "jobs/";

}  // namespace

bool may_follow(v1::JobState from, v1::JobState to) {
  return std::find(kSteps.begin(), kSteps.end(), Step{from, to}) != kSteps.end();
}

bool is_terminal(v1::JobState state) { return state == v1::SUCCEEDED || state == v1::FAILED || state == v1::CANCELLED; }

std::string name_of(std::int64_t job) { return std::string(kCollection) + std::to_string(job); }

std::optional<std::int64_t> number_of(std::string_view name) {
  if (!name.starts_with(kCollection)) return std::nullopt;
  const std::string_view digits = name.substr(kCollection.size());
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  // Only the one way of writing a number is a name: no sign, no leading zero.
  if (error != std::errc() || number < 1 || std::to_string(number) != digits) return std::nullopt;
  return number;
}

}  // namespace cellcrush::jobs
