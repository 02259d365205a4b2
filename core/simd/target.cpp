#include "simd/target.h"

#include <hwy/highway.h>

#include <algorithm>
#include <atomic>

#include "cellcrush/simd.h"

namespace cellcrush {
namespace {

constexpr const char* kScalar = "scalar";

std::atomic<bool> scalar_is_chosen = false;

struct Target {
  std::int64_t bit;
  std::string name;
};

std::string name_of(std::int64_t target) {
  switch (target) {
    case HWY_AVX3: return "avx512";
    case HWY_AVX2: return "avx2";
    case HWY_SSE4: return "sse4";
    default: break;
  }
  std::string name = hwy::TargetName(target);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

/// Vector targets that are both built and supported, the best first: better targets have lower bits.
const std::vector<Target>& wide_targets() {
  static const std::vector<Target> kTargets = [] {
    std::vector<Target> found;
    for (const std::int64_t bit : hwy::SupportedAndGeneratedTargets()) {
      if (bit != HWY_SCALAR && bit != HWY_EMU128) {
        found.push_back({bit, name_of(bit)});
      }
    }
    std::sort(found.begin(), found.end(), [](const Target& a, const Target& b) { return a.bit < b.bit; });
    return found;
  }();
  return kTargets;
}

}  // namespace

bool use_wide_kernels() { return !scalar_is_chosen.load(std::memory_order_relaxed) && !wide_targets().empty(); }

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (const Target& target : wide_targets()) {
    names.push_back(target.name);
  }
  names.emplace_back(kScalar);
  return names;
}

std::string simd_target() {
  if (scalar_is_chosen) {
    return kScalar;
  }
  const std::int64_t mask = hwy::SupportedTargets();
  for (const Target& target : wide_targets()) {
    if ((mask & target.bit) != 0) {
      return target.name;
    }
  }
  return kScalar;
}

bool use_simd_target(std::string_view name) {
  if (name == kScalar) {
    scalar_is_chosen = true;
    return true;
  }
  const std::vector<Target>& targets = wide_targets();
  if (name.empty() && targets.empty()) {
    return use_simd_target(kScalar);
  }
  const auto found = name.empty() ? targets.begin()
                                  : std::find_if(targets.begin(), targets.end(),
                                                 [&](const Target& target) { return target.name == name; });
  if (found == targets.end()) {
    return false;
  }
  scalar_is_chosen = false;
  hwy::SetSupportedTargetsForTest(found->bit);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return true;
}

}  // namespace cellcrush
