#include "commands/executor.h"

#include "commands/commands.h"

namespace cellcrush::client {

void add_executor_option(CLI::App& command, std::string& name) {
  command
      .add_option("--executor", name,
                  "Where jobs are computed: local, for the server's machine, or another executor of the server, such "
                  "as slurm/NAME (default: the server's --executor)")
      ->group(kScheduleOptions)
      ->type_name("NAME");
}

}  // namespace cellcrush::client
