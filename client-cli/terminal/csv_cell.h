#pragma once

#include <string>

namespace cellcrush::client {

/// A text as a cell of a CSV line: in quotes if it holds a comma, a quote or a line break.
std::string csv_cell(const std::string& text);

}  // namespace cellcrush::client
