#pragma once

#include <CLI/App.hpp>
#include <string>

namespace cellcrush {

/// The option of `app` whose long name is nearest to `name`, both without dashes; empty if none is near.
std::string nearest_option(const CLI::App& app, const std::string& name);

}  // namespace cellcrush
