#include "fracture/failure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fracture/part_walls.h"
#include "law/flow_curve.h"

namespace cellcrush {
namespace {

/// Stress of an outer fibre over the yield stress from which a section is looked at.
constexpr double kNearYield = 0.8;

/// Indices of the fibres of an element.
class FibreIndex {
 public:
  FibreIndex(const Scene& scene, const WallBlock& block, int j, int wall)
      : depth_(scene.section.depth_count()),
        stride_(static_cast<std::size_t>(block.walls)),
        element_(block.first_element + j * stride_ + (wall - block.first_wall)),
        first_((block.first_element + j * stride_) * scene.fibre_count() + (wall - block.first_wall)) {}

  [[nodiscard]] std::size_t element() const { return element_; }
  [[nodiscard]] std::size_t of(std::size_t p, std::size_t d) const { return first_ + (p * depth_ + d) * stride_; }
  [[nodiscard]] std::size_t left(std::size_t p) const { return of(p, depth_ - 1); }
  [[nodiscard]] std::size_t right(std::size_t p) const { return of(p, 0); }

 private:
  std::size_t depth_;
  std::size_t stride_;
  std::size_t element_;
  std::size_t first_;
};

/// Net plastic strain at a surface beyond an outer fibre. Strains are linear through the depth.
double at_surface(const Material& material, double stress, double plastic, double beyond) {
  const double elastic_room =
      plastic == 0.0 ? std::max(0.0, (material.yield_stress - std::abs(stress)) / material.youngs_modulus) : 0.0;
  const double sign = plastic == 0.0 ? std::copysign(1.0, stress) : std::copysign(1.0, plastic);
  return sign * std::max(0.0, sign * (plastic + beyond) - elastic_room);
}

/// Elongation over bending angle and thickness that the few fibres of a section alone can bring about: without an axial
/// force its neutral axis is anywhere between the two fibres next to the middle, and in tension beyond those from
/// `mean` = 2 `flow` times their offset on, as it should be.
double free_axis(const SectionRule& rule, double mean, double flow) {
  const double next_to_middle = rule.offset[rule.offset.size() / 2];
  return std::clamp(next_to_middle - 0.5 * mean / flow, 0.0, next_to_middle);
}

/// Length that two intervals have in common.
double common(double a, double b, double c, double d) { return std::max(0.0, std::min(b, d) - std::max(a, c)); }

/// Plastic work of a unit of volume, N / mm^2, by Simpson's rule.
double work_density(const Material& material, double plastic) {
  constexpr int kIntervals = 8;
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double weight = i == 0 || i == kIntervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * (material.yield_stress + curve_point(material.law, plastic * i / kIntervals).increase);
  }
  return sum * plastic / (3.0 * kIntervals);
}

const Material& material_of(const Scene& scene, int wall) { return scene.materials[scene.walls.material[wall]]; }

/// Index of the left outer fibre of a section into State::net_strain; the right one comes before it.
std::size_t left_of(const Scene& scene, std::size_t element, std::size_t p) {
  return 2 * (element * scene.section.section_count() + p) + 1;
}

/// Follows the outer fibres of a wall over the newest step. Returns whether any has yielded, or is near it.
bool follow_fibres(const Scene& scene, State& state, int wall, const WallBlock& block) {
  const double near = kNearYield * material_of(scene, wall).yield_stress;
  bool is_near = false;
  for (int j = 0; j < block.elements; ++j) {
    const FibreIndex index(scene, block, j, wall);
    for (std::size_t p = 0; p < scene.section.section_count(); ++p) {
      const std::size_t left = left_of(scene, index.element(), p);
      for (const auto& [fibre, at] : {std::pair(index.right(p), left - 1), std::pair(index.left(p), left)}) {
        NetPlasticStrain& strain = state.net_strain[at];
        const double stress = state.fibres.stress[fibre];
        const double now = state.fibres.plastic_strain[fibre];
        strain.net += std::copysign(now - strain.accumulated, stress - state.fibres.back_stress[fibre]);
        strain.accumulated = now;
        is_near = is_near || std::abs(stress) > near || strain.net != 0.0;
      }
    }
  }
  return is_near;
}

bool is_broken_end(const Scene& scene, const State& state, int joint) {
  return joint >= scene.joint_count - static_cast<int>(state.breaks.size());
}

}  // namespace

FailureSearch::FailureSearch(const Scene& scene) {
  for (const Material& material : scene.materials) {
    even_.push_back(Laws::kFacts[scene.law].even_strain(material.yield_stress, material.law));
  }
}

double FailureSearch::beyond_even(const Scene& scene, const State& state, int element, int wall) const {
  const Material& material = material_of(scene, wall);
  const double plastic = even_[scene.walls.material[wall]];
  const double stress = material.yield_stress + curve_point(material.law, plastic).increase;
  const double even = 1.0 + plastic + stress / material.youngs_modulus;
  return std::max(0.0, state.length[element] - even * scene.walls.undeformed_length[wall]);
}

void FailureSearch::add_unit(const Scene& scene, const State& state, int wall, const WallBlock& block) {
  const SectionRule& rule = scene.section;
  const Material& material = material_of(scene, wall);
  const double length = scene.walls.undeformed_length[wall];
  const double low = rule.offset[0];
  const double high = rule.offset[rule.offset.size() - 1];
  Unit unit;
  unit.wall = wall;
  unit.block = &block;
  unit.chain = scene.chain[block.first_element + wall - block.first_wall];
  unit.first_section = sections_.size();
  double to = 0.0;
  double wander = 0.0;
  for (int j = 0; j < block.elements; ++j) {
    const FibreIndex index(scene, block, j, wall);
    for (std::size_t p = 0; p < rule.section_count(); ++p) {
      const auto along = static_cast<Eigen::Index>(p);
      const std::size_t at = left_of(scene, index.element(), p);
      const double left = state.fibres.stress[index.left(p)];
      const double right = state.fibres.stress[index.right(p)];
      const double net_left = state.net_strain[at].net;
      const double net_right = state.net_strain[at - 1].net;
      const double slope =
          ((left - right) / material.youngs_modulus + net_left - net_right) / (high - low);  // of the total strain
      const double of_left = at_surface(material, left, net_left, slope * (0.5 - high));
      const double of_right = at_surface(material, right, net_right, slope * (-0.5 - low));
      double mean = 0.0;
      for (std::size_t d = 0; d < rule.depth_count(); ++d) {
        mean += rule.depth_weight[static_cast<Eigen::Index>(d)] * state.fibres.stress[index.of(p, d)];
      }
      const double from = to;
      to += rule.along_weight[along] * length;
      wander += std::abs(of_left - of_right) * (to - from) *
                free_axis(rule, mean, std::max({material.yield_stress, std::abs(left), std::abs(right)}));
      sections_.push_back(
          {0.5 * (of_left + of_right), 0.5 * (of_left - of_right), (j + rule.along[along]) * length, from, to});
    }
    unit.neck += beyond_even(scene, state, block.first_element + j * block.walls + wall - block.first_wall, wall);
  }
  unit.neck = std::max(0.0, unit.neck - wander);
  neck_[unit.chain] += unit.neck;
  unit.broken_start = is_broken_end(scene, state, scene.walls.start[wall]);
  unit.broken_end = is_broken_end(scene, state, scene.walls.end[wall]);
  unit.end_section = sections_.size();
  units_.push_back(unit);
}

void FailureSearch::collect(const Scene& scene, State& state) {
  units_.clear();
  sections_.clear();
  neck_.assign(static_cast<std::size_t>(1 + std::ranges::max(scene.chain)), 0.0);
  for (const WallBlock& block : scene.walls.blocks) {
    for (int wall = block.first_wall; wall < block.first_wall + block.walls; ++wall) {
      if (material_of(scene, wall).law.fails() && follow_fibres(scene, state, wall, block)) {
        add_unit(scene, state, wall, block);
      }
    }
  }
}

FailureSearch::Worst FailureSearch::worst_of(const Scene& scene, const Unit& unit) const {
  const Material& material = material_of(scene, unit.wall);
  const double even = even_[scene.walls.material[unit.wall]];
  const double elastic = material.yield_stress / material.youngs_modulus;
  const double thickness = scene.walls.thickness[unit.wall];
  const double length = sections_[unit.end_section - 1].to;
  const double gauge = std::min(thickness, length);
  Worst worst = {unit.chain, 0.0, &unit, 0};
  for (std::size_t k = unit.first_section; k < unit.end_section; ++k) {
    const SectionStrain& section = sections_[k];
    if (section.place > 0.5 * length ? unit.broken_end : unit.broken_start) continue;
    const double from = std::clamp(section.place - 0.5 * gauge, 0.0, length - gauge);
    double bend = 0.0;
    for (std::size_t i = unit.first_section; i < unit.end_section; ++i) {
      const SectionStrain& of = sections_[i];
      const double within = common(of.from, of.to, from, from + gauge);
      bend += of.bend * (i == k ? std::max(within, of.to - of.from) : within) / gauge;
    }
    const double stretched =
        unit.neck > 0.0 ? even + neck_[unit.chain] / thickness : std::min(section.even, even + elastic);
    const double reached = (stretched + std::abs(bend)) / material.law.failure_strain;
    if (reached > worst.reached) {
      worst.reached = reached;
      worst.section = k;
    }
  }
  return worst;
}

FailedEnd FailureSearch::end_at(const Scene& scene, const State& state, const Worst& worst) const {
  const Unit& unit = *worst.unit;
  const SectionStrain& section = sections_[worst.section];
  const std::size_t number = worst.section - unit.first_section;
  const std::size_t points = scene.section.section_count();
  const FibreIndex index(scene, *unit.block, static_cast<int>(number / points), unit.wall);
  const double volume = scene.walls.thickness[unit.wall] * scene.depth * (section.to - section.from);
  FailedEnd end = {unit.wall, section.place > 0.5 * sections_[unit.end_section - 1].to, 0.0};
  for (std::size_t d = 0; d < scene.section.depth_count(); ++d) {
    const double plastic = state.fibres.plastic_strain[index.of(number % points, d)];
    end.energy += volume * scene.section.depth_weight[static_cast<Eigen::Index>(d)] *
                  work_density(material_of(scene, unit.wall), plastic);
  }
  return end;
}

std::vector<FailedEnd> FailureSearch::find(const Scene& scene, State& state) {
  collect(scene, state);
  std::vector<Worst> failed;
  for (const Unit& unit : units_) {
    if (const Worst worst = worst_of(scene, unit); worst.reached >= 1.0) failed.push_back(worst);
  }
  std::ranges::stable_sort(failed, [](const Worst& a, const Worst& b) {
    return a.chain != b.chain ? a.chain < b.chain : a.reached > b.reached;
  });
  std::vector<FailedEnd> ends;
  int broken = -1;  // chain
  for (const Worst& worst : failed) {
    if (worst.chain == broken) continue;
    FailedEnd end = end_at(scene, state, worst);
    for (const bool at_end : {end.at_end, !end.at_end}) {
      end.at_end = at_end;
      if (worst.chain != broken && can_part(scene, ends, end)) {
        ends.push_back(end);
        broken = worst.chain;
      }
    }
  }
  std::ranges::sort(ends, {}, &FailedEnd::wall);
  return ends;
}

}  // namespace cellcrush
