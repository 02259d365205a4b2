#include "program.h"

#include <csignal>

namespace cellcrush::client::testing {

namespace {

std::vector<std::string> command_of(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"/usr/bin/env"};
  for (const char* name :
       {"NO_COLOR", "CELLCRUSH_SERVER", "CELLCRUSH_TLS_CA", "CELLCRUSH_TOKEN_FILE", "CELLCRUSH_TOKEN"})
    words.push_back(std::string("--unset=") + name);
  words.insert(words.end(), {"LC_ALL=C.UTF-8", "TERM=xterm", CELLCRUSH_PROGRAM});
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, int columns, const std::string& input)
    : Process(command_of(arguments), input, columns) {}

void Program::interrupt() const { send(SIGINT); }

ProgramResult run_program(const std::vector<std::string>& arguments, const std::string& input) {
  return Program(arguments, 0, input).wait();
}

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace cellcrush::client::testing
