#pragma once

namespace cellcrush::client {

/// What the standard output can show.
struct Terminal {
  bool interactive = false;  ///< a terminal that can be redrawn in place
  bool colour = false;       ///< interactive, and NO_COLOR is not set
  bool unicode = false;      ///< the locale's text is UTF-8
};

Terminal find_terminal();

/// Columns of the terminal now; where the standard output is none, $COLUMNS or else 80.
int terminal_width();

/// Lines of the terminal now; 24 when it does not say.
int terminal_height();

}  // namespace cellcrush::client
