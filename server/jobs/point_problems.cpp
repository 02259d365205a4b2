#include "jobs/point_problems.h"

#include <algorithm>

namespace cellcrush::jobs {
namespace {

constexpr const char* kDigits = "0123456789";
constexpr const char* kOfNumbers = "0123456789.e+-";

std::string without_numbers(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto number = std::min(text.find_first_of(kDigits, i), text.size());
    out += text.substr(i, number - i) + "#";
    i = std::min(text.find_first_not_of(kOfNumbers, number), text.size());
  }
  return out;
}

}  // namespace

void PointProblems::add(const v1::Problem& problem, std::size_t position, const std::string& point) {
  const auto [found, is_new] = seen_.try_emplace(key_of(problem), entries_.size());
  if (is_new) entries_.push_back({problem, position, point});
  Entry& entry = entries_[found->second];
  ++entry.count;
  if (merge_ == Merge::but_for_numbers && problem.SerializeAsString() != entry.problem.SerializeAsString())
    entry.is_equal = false;
}

google::protobuf::RepeatedPtrField<v1::Problem> PointProblems::merged() const {
  google::protobuf::RepeatedPtrField<v1::Problem> out;
  for (const auto& entry : entries_) {
    v1::Problem& problem = *out.Add();
    problem = entry.problem;
    if (entry.is_equal && entry.count == points_) continue;
    std::string where = " This applies to point " + std::to_string(entry.first + 1) + " of " + std::to_string(points_) +
                        " (" + entry.point + ")";
    if (entry.count > 1) where += " and to " + std::to_string(entry.count - 1) + " more";
    problem.set_message(problem.message() + where + ".");
  }
  return out;
}

std::string PointProblems::key_of(const v1::Problem& problem) const {
  if (merge_ == Merge::equal) return problem.SerializeAsString();
  return problem.field() + "\n" + without_numbers(problem.message());
}

}  // namespace cellcrush::jobs
