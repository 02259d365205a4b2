#include "cellcrush/device.h"
#include "cellcrush/scene.h"
#include "section/section_rule.h"

namespace cellcrush {

// What a crush on a device does not have (core/device/README.md).
std::optional<std::string> why_not_on_device(const Scene& scene) {
  if (scene.bands.size() > 1) return "its lattice has 50,000 elements or more";
  if (!scene.plates.present || !scene.rigid_walls.empty()) return "it is not crushed by plates";
  if (scene.plates.kinetic_share > 0.0) return "the speed of its plate is controlled";
  if (scene.plates.friction > 0.0 || scene.contact.friction > 0.0) return "its contacts have friction";
  if (scene.rigid.count() > 0) return "it has rigid parts";
  if (!scene.supports.empty() || scene.is_loaded()) return "it has supports or loads";
  if (scene.period.repeats()) return "its sides repeat";
  if (scene.can_break()) return "its walls can break";
  if (!scene.start_overlaps.empty()) return "its walls overlap before loading";
  if (scene.contact.bends) return "its segments bend";
  if (!has_known_counts(scene.section))
    return "its elements have another section rule than the default's or the paper's";
  if (Laws::kFacts[scene.law].keeps_tangent) return "the yield stress of its material follows a curve or a rate";
  return std::nullopt;
}

}  // namespace cellcrush
