
#include <hwy/highway.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "cellcrush/simd.h"

namespace cellcrush {
namespace {

struct Target {
  std::int64_t bit;
  std::string name;
};

std::string name_of(std::int64_t target) {
  switch (target) {
    case HWY_AVX3: return "avx512";
    case HWY_AVX2: return "avx2";
    default: break;
  }
  std::string name = hwy::TargetName(target);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

/// Targets that are both compiled in and supported, best first: better targets have lower bits.
const std::vector<Target>& targets() {
  static const std::vector<Target> kTargets = [] {
    std::vector<Target> found;
    for (const std::int64_t bit : hwy::SupportedAndGeneratedTargets()) {
      found.push_back({bit, name_of(bit)});
    }
    std::sort(found.begin(), found.end(), [](const Target& a, const Target& b) { return a.bit < b.bit; });
    return found;
  }();
  return kTargets;
}

/// What use_simd_target() chose. hwy::SupportedTargets() cannot be asked: it chooses the best target again.
const Target*& chosen_target() {
  static const Target* chosen = &targets().front();
  return chosen;
}

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (const Target& target : targets()) {
    names.push_back(target.name);
  }
  return names;
}

std::string simd_target() { return chosen_target()->name; }

bool use_simd_target(std::string_view name) {
  const std::vector<Target>& known = targets();  // before any is disabled
  const auto found = name.empty() ? known.begin() : std::find_if(known.begin(), known.end(), [&](const Target& target) {
    return target.name == name;
  });
  if (found == known.end()) {
    return false;
  }
  hwy::DisableTargets(found->bit - 1);  // all better ones
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  chosen_target() = &*found;
  return true;
}

}  // namespace cellcrush
