#pragma once

#include <google/protobuf/message.h>

#include <map>
#include <string>
#include <vector>

namespace cellcrush::client {

/// Capabilities of the standard output.
struct Terminal {
  bool interactive = false;  ///< a terminal that supports redrawing in place
  bool colour = false;       ///< interactive, and NO_COLOR is not set
  bool unicode = false;      ///< the locale uses UTF-8
};

Terminal find_terminal();

/// Current width of the terminal in columns; without a terminal $COLUMNS, else 80.
int terminal_width();

/// Current height of the terminal in lines; 24 if unknown.
int terminal_height();

/// Lines redrawn in place on a terminal, each redraw in one write. Nothing else may be printed in between.
class Redraw {
 public:
  void show(const std::vector<std::string>& lines);

 private:
  int lines_ = 0;  ///< lines of the last redraw above the cursor
};

/// A message as protobuf JSON on one line, with the proto's own field names, including zeros.
std::string json_text(const google::protobuf::Message& message);

/// Prints the same on stdout as one line, and flushes it.
void print_json(const google::protobuf::Message& message);

/// Prints {"path": PATH, NAME: COUNT...} of a file that a command wrote.
void print_file_json(const std::string& path, const std::map<std::string, int>& counts);

}  // namespace cellcrush::client
