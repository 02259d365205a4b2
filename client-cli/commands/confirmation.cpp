#include "commands/confirmation.h"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>

namespace cellcrush::client {

bool confirm(const std::function<std::string()>& question) {
  if (isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1) return true;
  fmt::print(stderr, "{} [y/N] ", question());
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

}  // namespace cellcrush::client
