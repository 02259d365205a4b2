#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/problem.pb.h"
#include "mutex.h"

namespace cellcrush {
class SpecChecker;
}

namespace cellcrush::translate {

/// Checks many cases for the problems of check_case, without its description. A case with the mesh of an earlier one
/// costs microseconds (cellcrush/spec_checker.h). Not thread-safe. Throws std::bad_alloc if a mesh does not fit.
class CaseChecker {
 public:
  CaseChecker();
  ~CaseChecker();
  CaseChecker(const CaseChecker&) = delete;
  CaseChecker& operator=(const CaseChecker&) = delete;

  struct Verdict {
    std::vector<v1::Problem> problems;
    std::vector<v1::Problem> notes;  ///< those of check_case; empty if there are problems
    std::int64_t element_count = 0;  ///< 0 if there are problems
    int default_mesh =
        0;  ///< elements_per_wall by default; 0 if the case gives it, if a frame, or if there are problems
    /// Time of the run, in element-steps of the reference crush (SpecChecker::Verdict); 0 if there are problems.
    std::int64_t element_steps = 0;
    /// The prediction of check_case, or slightly more (cellcrush/spec_checker.h); 0 if there are problems.
    std::int64_t most_memory_bytes = 0;
  };
  /// `before_mesh`: called with the approximate number of elements of the mesh, if one is to be built.
  using BeforeMesh = std::function<void(std::int64_t elements)>;
  Verdict check(const v1::Case& submitted, const BeforeMesh& before_mesh = {});

  /// Approximate number of elements in the mesh that check(submitted) would build; 0 if it would build none.
  [[nodiscard]] std::int64_t elements_to_build(const v1::Case& submitted) const;

 private:
  std::unique_ptr<SpecChecker> specs_;
};

/// Checkers for calls that come one after the other: they know the meshes of earlier calls. Thread-safe.
class SharedCheckers {
 public:
  /// As CaseChecker.
  CaseChecker::Verdict check(const v1::Case& submitted, const CaseChecker::BeforeMesh& before_mesh);

 private:
  Mutex mutex_;
  std::vector<std::unique_ptr<CaseChecker>> idle_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::translate
