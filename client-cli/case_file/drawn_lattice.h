#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::client {

/// A drawing of a lattice, and how it is read.
struct DrawingOptions {
  std::vector<std::string> files{};
  std::string unit{};                 ///< empty: as the file tells
  std::optional<double> thickness{};  ///< mm, of walls whose file does not tell it
  std::optional<double> tolerance{};  ///< mm
  std::optional<double> bond{};       ///< share of the thickness
  bool keeps_crossings = false;

  /// Whether an option is given that says how files are read.
  [[nodiscard]] bool says_how() const { return !unit.empty() || thickness || tolerance || bond || keeps_crossings; }
};

/// Makes a network of the drawing. Throws CommandError (refused).
v1::ImportLatticeResponse read_drawn_lattice(const DrawingOptions& options);

/// Replaces the lattice of a case, and what only that had.
void replace_lattice(const v1::Lattice::Network& network, v1::Case& target);

}  // namespace cellcrush::client
