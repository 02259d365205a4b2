#include "commands/priority.h"

#include <CLI/Validators.hpp>

#include "commands/commands.h"

namespace cellcrush::client {

void add_priority_option(CLI::App& command, int& priority) {
  command.add_option("--priority", priority, "Waiting jobs of higher priority start first; -100 to 100 (default: 0)")
      ->group(kScheduleOptions)
      ->check(CLI::Range(-100, 100));
}

}  // namespace cellcrush::client
