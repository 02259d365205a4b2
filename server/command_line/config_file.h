#pragma once

#include <CLI/App.hpp>
#include <map>
#include <string>

namespace cellcrush {

/// A TOML file of all options of the program, by their groups, each with its description and commented out; those of
/// `given`, key to value in TOML, are set. For packages: what it sets is what the service starts with.
std::string config_file(const CLI::App& app, const std::map<std::string, std::string>& given);

}  // namespace cellcrush
