#pragma once

#include <string>
#include <vector>

#include "expect_text.h"
#include "programs/process.h"
#include "programs/temporary_folder.h"
#include "programs/text_proto.h"

namespace cellcrush::client::testing {

using cellcrush::testing::from_json;
using cellcrush::testing::from_text;
using cellcrush::testing::text_of_file;
using ProgramResult = e2e::Outcome;

/// The real `cellcrush`, started with arguments; it is ended with the object at the latest.
class Program : public e2e::Process {
 public:
  /// `columns` above 0 gives it a terminal of that width. `input` is its standard input.
  explicit Program(const std::vector<std::string>& arguments, int columns = 0, const std::string& input = {});

  /// Reads its output until `text` has come; whether it has, within ten seconds.
  bool wait_for_output(const std::string& text) { return Process::wait_for_output(text, std::chrono::seconds(10)); }

  /// Sends SIGINT, as Ctrl-C does.
  void interrupt() const;

  /// Reads to its end, at most 30 seconds.
  ProgramResult wait() { return Process::wait(std::chrono::seconds(30)); }
};

/// Runs the program to its end.
ProgramResult run_program(const std::vector<std::string>& arguments, const std::string& input = {});

/// How often a part stands in a text.
int count_of(const std::string& text, const std::string& part);

}  // namespace cellcrush::client::testing
