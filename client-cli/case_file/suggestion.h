#pragma once

#include <google/protobuf/descriptor.h>

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::client {

/// The candidate nearest to `word` by insertions, deletions, substitutions and transpositions, ignoring case; empty if
/// none is close enough.
std::string find_nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The file in the same folder whose name is nearest to a missing one; empty if none is near.
std::string find_nearest_file(const std::string& missing);

/// Opens a file for reading. Returns an empty text, or the reason for failure, with the nearest name for a missing
/// file.
std::string open_failure(const std::string& file, std::ifstream& stream);

/// A message followed by `did you mean "NEAREST"?`; unchanged if `nearest` is empty.
std::string with_suggestion(std::string message, const std::string& nearest);

/// Names of the fields of a message, in order of declaration.
std::vector<std::string> field_names(const google::protobuf::Descriptor& type);

/// The message for a field that `type` does not have: a sentence with the nearest name, or with all names if none is
/// near.
std::string unknown_field_message(std::string_view field, const google::protobuf::Descriptor& type);

/// The message for a value that `type` does not have: a sentence with all its names.
std::string unknown_enum_message(std::string_view value, const google::protobuf::EnumDescriptor& type);

}  // namespace cellcrush::client
