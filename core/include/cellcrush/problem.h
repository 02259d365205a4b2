#pragma once

#include <string>
#include <vector>

namespace cellcrush {

/// One thing that keeps a case from running: where, what was found, what is wrong, what to do.
struct Problem {
  enum class Kind {
    invalid,        ///< the value cannot be right
    unimplemented,  ///< the value is meaningful but this solver cannot do it
  };

  std::string field;    ///< path in the case, such as "lattice.hexagon.side_mm"
  std::string value;    ///< what was found, as text; empty when the field is missing
  std::string message;  ///< what is wrong, a sentence
  std::string remedy;   ///< what to do about it, a sentence
  Kind kind = Kind::invalid;
};

using Problems = std::vector<Problem>;

}  // namespace cellcrush
