#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cellcrush::client {

/// What the comments and options of case.proto say about a field or, for an empty path, about the whole case.
struct FieldManual {
  std::string path;
  std::string type;           ///< as in the proto, such as "double" or "enum Direction"
  std::string unit;           ///< empty: none
  std::string default_value;  ///< "required" for one without; empty for a group
  std::string limits;         ///< empty: only those of the type
  std::string comment;
  std::vector<std::pair<std::string, std::string>> values;  ///< of an enum: name and comment
  std::vector<std::pair<std::string, std::string>> fields;  ///< of a message: name and first sentence
};

/// Looks up a path such as "lattice.frame.nodes[0].x_mm"; list indices are optional. Throws CommandError (refused) for
/// an unknown path, with the nearest one.
FieldManual find_field_manual(const std::string& path);

}  // namespace cellcrush::client
