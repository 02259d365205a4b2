#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::translate {

// Facts of a case in words (case_words.h).

inline void add_fact(v1::CaseWords& words, const std::string& heading, std::string text) {
  auto& fact = *words.add_facts();
  fact.set_heading(heading);
  fact.set_text(std::move(text));
}

// The first names of a list, and how many more there are.
template <typename Names>
std::string names_text(const Names& names) {
  constexpr int kShown = 6;
  const auto count = static_cast<int>(names.size());
  std::string text = fmt::format("{}", fmt::join(names.begin(), names.begin() + std::min(count, kShown), ", "));
  if (count > kShown) text += fmt::format(" and {} more", count - kShown);
  return text;
}

// A fact for a list that has entries: the first ones, each as `text` has it.
template <typename Range, typename Text>
void add_list(v1::CaseWords& words, const char* heading, const Range& range, Text text) {
  std::vector<std::string> texts;
  for (const auto& item : range) texts.push_back(text(item));
  if (!texts.empty()) add_fact(words, heading, names_text(texts));
}

/// Gravity, rigid walls, sides, grips and the end of the run. REQUIRES: whether there are plates is known.
void describe_loading(const v1::Loading& loading, v1::CaseWords& words);

}  // namespace cellcrush::translate
