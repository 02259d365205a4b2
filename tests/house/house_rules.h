#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::house {

/// One place where the tree breaks a rule of the house.
struct Violation {
  std::string file;  ///< path from the root of the tree, with forward slashes
  int line = 0;      ///< from 1; 0 when the entry itself breaks the rule
  std::string rule;  ///< the rule and what broke it, a sentence
};

/// Reads every header, source file and script below `root` and reports all violations, in the order of the paths:
///
/// - core includes its own headers, the C++ library without clock and files, Eigen, and, but for its public headers,
///   Highway;
/// - core/include, which others may include, takes of core's headers only those in core/include;
/// - server includes no header of core but those in core/include;
/// - server includes no header of client-cli but those in client-cli/usage, which both programs answer with, and in
///   client-cli/drawing, the drawings that both read;
/// - client-cli includes no header of core or server;
/// - of server, only server/translate joins messages (*.pb.h) and core's headers in one file;
/// - no two folders of core, and none of server, include each other, directly or along other folders;
/// - nobody but tests includes tests;
/// - the root holds the agreed entries and no other;
/// - lines of sources and scripts end within 120 columns.
///
/// Only what a file includes itself counts, not what those headers include. Throws std::filesystem::filesystem_error
/// when the tree cannot be read.
std::vector<Violation> check_house(const std::filesystem::path& root);

/// "file:line: rule" a line, for messages.
std::string to_text(const std::vector<Violation>& violations);

}  // namespace cellcrush::house
