#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "case_file/drawn_lattice.h"
#include "cellcrush/v1/case.pb.h"

namespace cellcrush::client {

class Connection;

/// The CASE argument and what changes the case.
struct CaseOptions {
  std::string source;
  DrawingOptions lattice{};  ///< no files: the lattice of the case
  std::vector<std::string> assignments{};
};

/// Reads the CASE argument: a file (protobuf text, or JSON if its name ends in .json or its text begins with "{"), "-"
/// for stdin, or "preset:NAME", which the server provides. Then puts the drawing of `--lattice` in place of its
/// lattice, and applies the `--set` assignments in order. The report of the drawing is printed on stderr, or goes to
/// `report`. Throws CommandError.
v1::Case read_case(const CaseOptions& options, Connection& connection, v1::ImportReport* report = nullptr);

/// The same without a server; nothing for a preset.
std::optional<v1::Case> read_own_case(const CaseOptions& options);

/// NAME of "preset:NAME", or empty.
std::string preset_name(const std::string& source);

/// Opens a file for reading. Returns an empty text, or the reason for failure, with the nearest name for a missing
/// file.
std::string open_failure(const std::string& file, std::ifstream& stream);

/// The bytes of a file. Throws CommandError (refused) with that reason.
std::string read_bytes(const std::string& file);

/// Reads a case from protobuf text. Throws CommandError (refused) with all errors found, one per line as
/// "FILE:LINE:COLUMN: message" (counted from 1), with suggestions for misspelt fields.
v1::Case parse_text_case(const std::string& text, const std::string& file);

/// Reads a case from protobuf JSON (field names as in the proto, or in lowerCamelCase). Throws CommandError (refused)
/// with the path of the invalid field, as "FILE: path: message".
v1::Case parse_json_case(const std::string& text, const std::string& file);

}  // namespace cellcrush::client
