#include "scene/imperfection.h"

namespace cellcrush {
namespace {

/// SplitMix64 (Steele, Lea and Flood, 2014), because the distributions of the standard library differ between
/// implementations.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}

  /// Uniform in [-1, 1).
  double next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebULL;
    mixed ^= mixed >> 31U;
    return static_cast<double>(mixed >> 11U) * 0x1p-52 - 1.0;
  }

 private:
  std::uint64_t state_;
};

}  // namespace

void perturb(const Imperfection& imperfection, std::vector<Vector2>& joints) {
  if (imperfection.amplitude_mm == 0.0) {
    return;
  }
  Draw draw(imperfection.seed);
  for (Vector2& joint : joints) {
    joint.x() += imperfection.amplitude_mm * draw.next();
    joint.y() += imperfection.amplitude_mm * draw.next();
  }
}

}  // namespace cellcrush
