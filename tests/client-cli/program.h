#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::client::testing {

struct ProgramResult {
  int exit_code = -1;  ///< -1 when it was ended by a signal, or did not end in time
  std::string output;
  std::string errors;  ///< empty for a program on a terminal, whose errors are in `output`
  double seconds = 0.0;
};

/// The real `cellcrush`, started with arguments; it is ended with the object at the latest.
class Program {
 public:
  /// `columns` above 0 gives it a terminal of that width. `input` is its standard input.
  explicit Program(const std::vector<std::string>& arguments, int columns = 0, const std::string& input = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Reads its output until `text` has come; whether it has, within ten seconds.
  bool wait_for_output(const std::string& text);
  /// Types `text` on its terminal.
  void type(const std::string& text) const;
  /// Sends SIGINT, as Ctrl-C does.
  void interrupt() const;
  /// Reads to its end, at most 30 seconds.
  ProgramResult wait();

 private:
  bool read_some(int milliseconds);

  pid_t process_ = -1;
  int output_ = -1;
  int errors_ = -1;
  double started_ = 0.0;
  ProgramResult result_;
};

/// Runs the program to its end.
ProgramResult run_program(const std::vector<std::string>& arguments, const std::string& input = {});

/// All bytes of a file that a command wrote; none when there is no such file.
std::string read_file(const std::filesystem::path& path);

}  // namespace cellcrush::client::testing
