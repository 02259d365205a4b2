#include "commands/time_limit.h"

#include <CLI/Validators.hpp>
#include <map>
#include <string>

#include "commands/commands.h"

namespace cellcrush::client {

void add_time_limit_option(CLI::App& command, double& seconds, const std::string& default_text) {
  const std::map<std::string, double> units = {{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}};
  command
      .add_option("--time-limit", seconds,
                  "Wall-clock limit per job in s, min, h or d, such as 90s or 2h, at least 0.001 s; results up to the "
                  "limit are kept (default: " +
                      default_text + ")")
      ->group(kScheduleOptions)
      ->type_name("TIME")
      ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::CASE_SENSITIVE).description(""))
      ->check(CLI::Range(0.001, 1e9).description(""));
}

}  // namespace cellcrush::client
