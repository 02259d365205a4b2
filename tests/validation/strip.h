#pragma once

#include <string>
#include <vector>

#include "validation/records.h"

namespace cellcrush::validation {

/// A crush in a strip of drawings.
struct StripRow {
  std::string title;  ///< stands above each of its drawings
  KeptFrames kept;
};

/// Draws, into a file whose name ends in .svg or .png, of every row the frames that are nearest to the asked strains,
/// side by side, all at one scale, walls coloured by plastic fraction, with their strains and the plate's travel.
/// Throws std::invalid_argument when a row has no frame within 0.03 of a strain or on another name, std::runtime_error
/// when the file cannot be written.
void draw_strip(const std::string& file, const std::vector<StripRow>& rows, const std::vector<double>& strains);

}  // namespace cellcrush::validation
