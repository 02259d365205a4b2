#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "house/house_rules.h"

namespace cellcrush::house {

/// Which folders of core and of server include which others of the same room. Files that stand in no folder, and the
/// public headers of core, do not count.
class FolderArrows {
 public:
  /// Notes that a file includes another, both as paths from the root.
  void add(const std::string& file, int line, const std::string& included);

  /// Violations that together name every folder on a way round. Each names the folders of a shortest one and its
  /// include lines, and stands at the first of them.
  [[nodiscard]] std::vector<Violation> find_cycles() const;

 private:
  using Lines = std::set<std::pair<std::string, int>>;  ///< files and lines of one arrow

  /// The folders on a shortest way from a folder back to itself, which is both its first and last; empty when there is
  /// none.
  [[nodiscard]] std::vector<std::string> way_round(const std::string& folder) const;

  std::map<std::string, std::map<std::string, Lines>> arrows_;  ///< from folder to folder, "core/step"
};

}  // namespace cellcrush::house
