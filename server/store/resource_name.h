#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cellcrush::store {

/// "jobs/12" for 12.
std::string name_of(std::int64_t job);

/// 12 for "jobs/12"; nothing for a text that cannot be a job's name.
std::optional<std::int64_t> number_of(std::string_view name);

/// "sweeps/12" for 12.
std::string sweep_name_of(std::int64_t sweep);

/// 12 for "sweeps/12"; nothing for a text that cannot be a sweep's name.
std::optional<std::int64_t> sweep_number_of(std::string_view name);

/// A random name of 16 hexadecimal digits.
std::string random_name();

}  // namespace cellcrush::store
