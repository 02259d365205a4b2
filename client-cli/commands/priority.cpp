#include "commands/priority.h"

#include <CLI/Validators.hpp>

namespace cellcrush::client {

void add_priority_option(CLI::App& command, int& priority) {
  command.add_option("--priority", priority, "Of the jobs that wait, higher ones start first (default: 0)")
      ->check(CLI::Range(-100, 100));
}

}  // namespace cellcrush::client
