#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace cellcrush {

/// For each of `count` nodes, the lowest of the nodes to which the links connect it; its own number if none does. Links
/// run from their `start` to their `end`.
template <class Links>
std::vector<int> find_parts(std::size_t count, const Links& links) {
  std::vector<int> part(count);
  std::iota(part.begin(), part.end(), 0);
  const auto root_of = [&](int node) {
    while (part[node] != node) {
      part[node] = part[part[node]];
      node = part[node];
    }
    return node;
  };
  for (const auto& link : links) {
    const auto [low, high] = std::minmax({root_of(link.start), root_of(link.end)});
    part[high] = low;
  }
  for (int& node : part) {
    node = root_of(node);
  }
  return part;
}

}  // namespace cellcrush
