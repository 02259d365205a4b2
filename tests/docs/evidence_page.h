#pragma once

#include <set>
#include <string>

#include "docs/links.h"
#include "scenes/evidence.h"

namespace cellcrush::docs {

/// A page in which results name what tests recorded before they tell it: "worst error <!--error over L-->1.2e-4 L".
struct EvidencePage {
  std::string text;
  Findings findings;  ///< what is wrong with the text or the record
};

/// Writes the numbers into the tables (claim, reference, result, test) of a page again. A name stands for the row of
/// `evidence` that has its quantity and a test that the table's row names, with ... for any letters. Results have no
/// digits but those of names, equations (E11, Eq. 51) and code, except in a section that says kByHand. Every test that
/// is named is one of `tests`, and every row of `evidence` stands in the page.
EvidencePage make_evidence_page(const std::string& text, const scenes::Evidence& evidence,
                                const std::set<std::string>& tests);

inline constexpr const char* kByHand = "Results of this section are written by hand.";

}  // namespace cellcrush::docs
