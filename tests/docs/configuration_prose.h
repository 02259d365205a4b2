#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cellcrush::docs {

/// What the page says of an option beside its help.
struct OptionProse {
  std::string value;  ///< what stands for its value: "MIB"
  std::string unit;   ///< of the value, empty where it has none
  std::vector<std::string> paragraphs;
};

/// Options that the page describes together.
struct OptionGroup {
  std::string title;
  std::string introduction;
  std::vector<std::pair<std::string, OptionProse>> options;  ///< by their long names
};

/// All groups, in the order of the page.
std::vector<OptionGroup> option_groups();

extern const char* const kHead;
extern const char* const kExample;
extern const char* const kBehindExample;
extern const char* const kTail;

}  // namespace cellcrush::docs
