#pragma once

#include <google/protobuf/descriptor.h>

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::client {

/// The candidate nearest to `word` by insertions, deletions, substitutions and swaps of neighbours (case does not
/// count); empty when none is near enough to be meant.
std::string find_nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The file nearest in name to one that is missing, in the same folder; empty when none is near.
std::string find_nearest_file(const std::string& missing);

/// Opens a file for reading. Returns an empty text, or why it cannot be read, with the nearest name of one that is
/// missing.
std::string open_failure(const std::string& file, std::ifstream& stream);

/// A message with `did you mean "NEAREST"?` behind it; unchanged when `nearest` is empty.
std::string with_suggestion(std::string message, const std::string& nearest);

/// Names of the fields of a message, in the order of their declaration.
std::vector<std::string> field_names(const google::protobuf::Descriptor& type);

/// What to say about a field that `type` does not have: a sentence with the nearest name, or all names when none is
/// near.
std::string unknown_field_message(std::string_view field, const google::protobuf::Descriptor& type);

/// What to say about a value that `type` does not have: a sentence with all its names.
std::string unknown_enum_message(std::string_view value, const google::protobuf::EnumDescriptor& type);

}  // namespace cellcrush::client
