#pragma once

#include <gmock/gmock.h>

#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "chart/display_text.h"
#include "command_error.h"

namespace cellcrush::client::testing {

/// Expects every part to stand in a text.
inline void expect_parts_in(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_THAT(text, ::testing::HasSubstr(part));
}

/// Expects no line of a text, or of a display on a terminal, to be wider than so many columns.
inline void expect_no_wider(const std::string& text, int columns) {
  static const std::regex kNoRoom("\x1b\\[[^a-zA-Z]*[a-zA-Z]|\r");
  std::istringstream lines(std::regex_replace(text, kNoRoom, ""));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(display_width(line), columns) << line;
}

/// The message of the CommandError (refused) that a call throws; empty without one.
template <typename Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.code(), ExitCode::refused);
    return error.message();
  }
  return {};
}

}  // namespace cellcrush::client::testing
