#include "jobs/sweep_plan.h"

#include <string>
#include <utility>

#include "error.h"
#include "jobs/case_field.h"
#include "jobs/point_problems.h"
#include "jobs/sweep_points.h"
#include "translate/case_checker.h"

namespace cellcrush::jobs {
namespace {

constexpr std::size_t kLongestTitle = 200;                 // of a case, in bytes
constexpr std::size_t kMostCaseBytes = 256 * 1024 * 1024;  // of all cases of a sweep
constexpr std::size_t kMostLabelBytes = 16 * 1024 * 1024;  // of the labels of all its jobs

void cut(std::string& text, std::size_t most) {
  if (text.size() <= most) return;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  text.resize(most);
}

std::size_t bytes_of_labels(const v1::Sweep& sweep) {
  std::size_t out = 0;
  for (const auto& [key, value] : sweep.labels()) out += key.size() + value.size();
  return out;
}

// "loading.speed_m_per_s = 50, lattice.hexagon.rows = 6".
std::string text_of_point(const std::vector<std::string>& fields, const std::vector<double>& values) {
  std::string out;
  for (std::size_t i = 0; i < fields.size(); ++i) out += (i == 0 ? "" : ", ") + fields[i] + " = " + text_of(values[i]);
  return out;
}

// The case's own title is cut rather than the values.
std::string title_of(std::string title, std::string point) {
  cut(point, kLongestTitle);
  if (point.size() + 2 >= kLongestTitle) return point;
  cut(title, kLongestTitle - point.size() - 2);
  return title.empty() ? point : title + ", " + point;
}

v1::Problem problem_of(const InvalidField& refused) {
  v1::Problem out;
  out.set_field(refused.field());
  out.set_message(refused.message());
  out.set_remedy(refused.remedy());
  out.set_kind(v1::Problem::INVALID);
  return out;
}

// The case of a point, and what the solver says of it.
v1::Case build_case(const v1::Sweep& sweep, const std::vector<std::string>& fields, const std::vector<double>& values,
                    const std::string& point, translate::CaseChecker& checker,
                    translate::CaseChecker::Verdict& verdict) {
  v1::Case out = sweep.case_();
  try {
    for (std::size_t i = 0; i < fields.size(); ++i) set_case_field(out, fields[i], values[i]);
  } catch (const InvalidField& refused) {
    verdict.problems.push_back(problem_of(refused));
    return out;
  }
  verdict = checker.check(out);
  out.set_title(title_of(out.title(), point));
  return out;
}

}  // namespace

SweepPlan plan_sweep(const v1::Sweep& sweep, const std::function<bool()>& given_up) {
  const SweepPoints points = expand(sweep);
  if (sweep.case_().ByteSizeLong() * points.values.size() > kMostCaseBytes) {
    throw InvalidField("sweep",
                       "has " + std::to_string(points.values.size()) + " points, too many for a case of this size.",
                       "Use fewer points: all cases together may have at most 256 MiB.");
  }
  if (bytes_of_labels(sweep) * points.values.size() > kMostLabelBytes) {
    throw InvalidField(
        "sweep.labels",
        "have " + std::to_string(bytes_of_labels(sweep)) + " bytes, too many for " +
            std::to_string(points.values.size()) + " jobs.",
        "Use fewer or shorter labels, or fewer points: the labels of all jobs together may have at most 16 MiB.");
  }
  SweepPlan out;
  PointProblems problems(points.values.size(), PointProblems::Merge::equal);
  PointProblems notes(points.values.size(), PointProblems::Merge::but_for_numbers);
  translate::CaseChecker checker;
  for (std::size_t i = 0; i < points.values.size(); ++i) {
    if (given_up())
      throw ServiceError(ServiceError::Kind::cancelled, "The client cancelled the call. No sweep was created.");
    const std::string point = text_of_point(points.fields, points.values[i]);
    translate::CaseChecker::Verdict verdict;
    v1::Job job;
    *job.mutable_case_() = build_case(sweep, points.fields, points.values[i], point, checker, verdict);
    *job.mutable_labels() = sweep.labels();
    job.set_priority(sweep.priority());
    job.set_time_limit_s(sweep.time_limit_s());
    job.set_owner(sweep.owner());
    for (const auto& problem : verdict.problems) problems.add(problem, i, point);
    for (const auto& note : verdict.notes) notes.add(note, i, point);
    if (verdict.most_memory_bytes > out.most_memory_bytes) {
      out.most_memory_bytes = verdict.most_memory_bytes;
      out.largest = i;
    }
    out.jobs.push_back({std::move(job), points.values[i], verdict.element_steps});
  }
  out.problems = problems.merged();
  if (out.problems.empty()) out.notes = notes.merged();
  if (!out.problems.empty()) out.most_memory_bytes = 0;
  return out;
}

}  // namespace cellcrush::jobs
