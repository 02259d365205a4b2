#pragma once

#include <set>
#include <string>

#include "docs/links.h"
#include "scenes/evidence.h"

namespace cellcrush::docs {

/// A page made from a text in which results name what tests recorded: "worst error {error over L} L".
struct EvidencePage {
  std::string text;
  Findings findings;  ///< what is wrong with the text or the record
};

/// Fills the tables (claim, reference, result, test) of a text. A placeholder stands for the row of `evidence` that has
/// its quantity and a test that the table's row names, with ... for any letters. Results have no digits but those of
/// placeholders, equations (E11, Eq. 51) and code, except in a section that says kByHand. Every test that is named
/// is one of `tests`, and every row of `evidence` stands in the page.
EvidencePage make_evidence_page(const std::string& text, const scenes::Evidence& evidence,
                                const std::set<std::string>& tests);

inline constexpr const char* kByHand = "Results of this section are written by hand.";

}  // namespace cellcrush::docs
