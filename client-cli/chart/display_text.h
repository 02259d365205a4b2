#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::client {

/// Columns of `text` (UTF-8) on a terminal, one per character.
int display_width(std::string_view text);

/// `text` with non-breaking spaces; wrap_words() and breakable() convert them back to spaces.
std::string unbreakable(std::string_view text);
std::string breakable(std::string_view text);

/// `text` truncated to `width` columns, with "..." at the cut if there is room.
std::string cut(std::string_view text, int width);

/// `text` wrapped to at most `width` columns, between words. A longer word is broken after the last joining sign that
/// fits, else at the end of the line. At least one line. REQUIRES: width is above 0.
std::vector<std::string> wrap_words(std::string_view text, int width);

/// Each line of the text wrapped like that. Adds no line break at the end.
std::string wrap_text(std::string_view text, int width);

/// The lines of wrap_words() with `first` before the first and `next` before the others, each at most `width` columns
/// in total and terminated by a line break.
std::string wrapped(std::string_view text, int width, std::string_view first = {}, std::string_view next = {});

/// `text` with control characters other than line ends, characters that change the direction of text, and invalid UTF-8
/// replaced by escapes such as \x1b, so that untrusted text can neither control the terminal nor reorder a line.
std::string printable(std::string_view text);

/// `text` with ? in place of bytes that are not UTF-8, as those of a file in Latin-1.
std::string valid_utf8(std::string_view text);

}  // namespace cellcrush::client
