#pragma once

#include <string>
#include <vector>

namespace cellcrush {

/// One reason why a case cannot run: the field, its value, what is wrong and what to do.
struct Problem {
  std::string field;    ///< path in the case, such as "lattice.hexagon.side_mm"
  std::string value;    ///< value found, as text; empty if the field is missing
  std::string message;  ///< what is wrong, as a sentence
  std::string remedy;   ///< what to do about it, as a sentence
};

using Problems = std::vector<Problem>;

}  // namespace cellcrush
