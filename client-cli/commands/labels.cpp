#include "commands/labels.h"

#include "command_error.h"
#include "commands/commands.h"

namespace cellcrush::client {

void add_label_option(CLI::App& command, std::vector<std::string>& labels) {
  command
      .add_option("--label", labels,
                  "Label KEY=VALUE for list --filter; KEY up to 63 and VALUE up to 255 characters (may be repeated up "
                  "to 64 times; "
                  "default: none)")
      ->group(kIdentityOptions)
      ->allow_extra_args(false);
}

Labels parse_labels(const std::vector<std::string>& texts) {
  Labels labels;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw CommandError(ExitCode::refused, "--label " + text + ": expected KEY=VALUE");
    }
    labels[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return labels;
}

}  // namespace cellcrush::client
