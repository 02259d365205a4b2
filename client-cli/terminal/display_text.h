#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "terminal/printable.h"

namespace cellcrush::client {

/// Columns that `text` (UTF-8) takes on a terminal, a character a column.
int display_width(std::string_view text);

/// `text` with blanks at which lines are not broken; wrap_words() and breakable() make them plain blanks again.
std::string unbreakable(std::string_view text);
std::string breakable(std::string_view text);

/// `text` cut to `width` columns, with "..." at the cut where there is room for it.
std::string cut(std::string_view text, int width);

/// `text` in lines of at most `width` columns, broken between words; a longer word is broken behind the last sign
/// that joins its parts, else where the line ends. At least one line. REQUIRES: width is above 0.
std::vector<std::string> wrap_words(std::string_view text, int width);

/// The same lines with `first` before the first and `next` before the others, each at most `width` columns in all and
/// ended by a line break.
std::string wrapped(std::string_view text, int width, std::string_view first = {}, std::string_view next = {});

}  // namespace cellcrush::client
