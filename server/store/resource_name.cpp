#include "store/resource_name.h"

#include <fmt/format.h>

#include <charconv>
#include <random>

namespace cellcrush::store {
namespace {

constexpr std::string_view kJobs = "jobs/";
constexpr std::string_view kSweeps = "sweeps/";

std::string name_in(std::string_view collection, std::int64_t number) {
  return std::string(collection) + std::to_string(number);
}

std::optional<std::int64_t> number_in(std::string_view collection, std::string_view name) {
  if (!name.starts_with(collection)) return std::nullopt;
  const std::string_view digits = name.substr(collection.size());
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  // A number has exactly one valid form: no sign, no leading zero.
  if (error != std::errc() || number < 1 || std::to_string(number) != digits) return std::nullopt;
  return number;
}

}  // namespace

std::string name_of(std::int64_t job) { return name_in(kJobs, job); }

std::optional<std::int64_t> number_of(std::string_view name) { return number_in(kJobs, name); }

std::string sweep_name_of(std::int64_t sweep) { return name_in(kSweeps, sweep); }

std::optional<std::int64_t> sweep_number_of(std::string_view name) { return number_in(kSweeps, name); }

std::string random_name() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

}  // namespace cellcrush::store
