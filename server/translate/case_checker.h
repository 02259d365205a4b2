#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/problem.pb.h"

namespace cellcrush {
class SpecChecker;
}

namespace cellcrush::translate {

/// Checks many cases with the problems of check_case and without its description. Those that have the mesh of an
/// earlier one cost microseconds (cellcrush/spec_checker.h). Not thread-safe. Throws std::bad_alloc when a mesh does
/// not fit.
class CaseChecker {
 public:
  CaseChecker();
  ~CaseChecker();
  CaseChecker(const CaseChecker&) = delete;
  CaseChecker& operator=(const CaseChecker&) = delete;

  struct Verdict {
    std::vector<v1::Problem> problems;
    std::vector<v1::Problem> notes;  ///< what is hardly meant; empty when there are problems
    std::int64_t element_steps = 0;  ///< elements times steps of the run; 0 when there are problems
    /// What check_case predicts, or a little more (cellcrush/spec_checker.h); 0 when there are problems.
    std::int64_t most_memory_bytes = 0;
  };
  Verdict check(const v1::Case& submitted);

  /// Elements of the mesh that check(submitted) would build, about; 0 where it would build none.
  [[nodiscard]] std::int64_t elements_to_build(const v1::Case& submitted) const;

 private:
  std::unique_ptr<SpecChecker> specs_;
};

}  // namespace cellcrush::translate
