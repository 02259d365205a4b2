#include "translate/case_checker.h"

#include <cmath>
#include <utility>

#include "cellcrush/fidelity.h"
#include "cellcrush/spec_checker.h"
#include "translate/case_to_spec.h"
#include "translate/check_case.h"
#include "translate/loads_places.h"
#include "translate/materials.h"
#include "translate/worker_memory.h"

namespace cellcrush::translate {
namespace {

// What checkers know takes at most a few megabytes: they forget large cases, as of frames.
constexpr std::size_t kMostIdleCheckers = 4;
constexpr std::size_t kMostBytesOfKnown = 4096;

}  // namespace

CaseChecker::CaseChecker() : specs_(std::make_unique<SpecChecker>()) {}

CaseChecker::~CaseChecker() = default;

CaseChecker::Verdict CaseChecker::check(const v1::Case& submitted, const BeforeMesh& before_mesh) {
  Verdict out;
  for (auto& problem : find_long_lists(submitted)) out.problems.push_back(std::move(problem));
  if (!out.problems.empty()) return out;
  auto reading = to_spec(submitted);
  auto verdict = specs_->check(reading.spec, before_mesh);
  name_as_given(submitted, verdict.problems);
  for (const Problems* problems : {&reading.problems, &verdict.problems}) {
    for (const auto& problem : *problems) out.problems.push_back(to_proto(problem));
  }
  if (!out.problems.empty()) return out;
  for (const auto& note : notes_on_named(submitted, verdict.notes)) {
    out.notes.push_back(to_proto(note, v1::Problem::IMPLAUSIBLE));
  }
  out.element_count = verdict.element_count;
  const bool has_default_mesh = !reading.spec.elements_per_wall && !submitted.lattice().has_frame();
  if (has_default_mesh) out.default_mesh = *fill_in_fidelity(reading.spec).elements_per_wall;
  out.element_steps = std::llround(verdict.reference_steps);
  out.most_memory_bytes = memory_of_worker(
      reading.spec, {verdict.most_memory_bytes, verdict.element_count, reading.spec.output.sample_count});
  return out;
}

std::int64_t CaseChecker::elements_to_build(const v1::Case& submitted) const {
  return find_long_lists(submitted).empty() ? specs_->elements_to_build(to_spec(submitted).spec) : 0;
}

CaseChecker::Verdict SharedCheckers::check(const v1::Case& submitted, const CaseChecker::BeforeMesh& before_mesh) {
  std::unique_ptr<CaseChecker> own;
  {
    const MutexLock lock(mutex_);
    if (!idle_.empty()) {
      own = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!own) own = std::make_unique<CaseChecker>();
  auto out = own->check(submitted, before_mesh);
  if (submitted.ByteSizeLong() > kMostBytesOfKnown) return out;
  const MutexLock lock(mutex_);
  if (idle_.size() < kMostIdleCheckers) idle_.push_back(std::move(own));
  return out;
}

}  // namespace cellcrush::translate
