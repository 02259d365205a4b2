#pragma once

#include <string>

#include "cellcrush/v1/sweep.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

inline constexpr int kTableDigits = 3;

/// A shown_table() aligned, with `digits` significant digits; means with their intervals. Below it: common values, the
/// meaning of the columns, `theory_note` if any, the fit of plateau against speed if any, and why jobs failed.
std::string sweep_table_text(const v1::SweepTable& table, const std::string& theory_note, int digits = kTableDigits,
                             int width = terminal_width());

}  // namespace cellcrush::client
