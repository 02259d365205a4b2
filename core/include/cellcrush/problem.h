#pragma once

#include <string>
#include <vector>

namespace cellcrush {

/// One thing that keeps a case from running: where, what was found, what is wrong, what to do.
struct Problem {
  std::string field;    ///< path in the case, such as "lattice.hexagon.side_mm"
  std::string value;    ///< what was found, as text; empty when the field is missing
  std::string message;  ///< what is wrong, a sentence
  std::string remedy;   ///< what to do about it, a sentence
};

using Problems = std::vector<Problem>;

}  // namespace cellcrush
