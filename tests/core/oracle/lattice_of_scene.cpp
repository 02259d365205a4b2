#include "core/oracle/lattice_of_scene.h"

#include <algorithm>

#include "cellcrush/simd.h"

namespace cellcrush {
namespace {

reference::Material material_of(const Scene& scene, const Element& element) {
  const Material& material = scene.materials[element.material];
  const LawParameters& law = material.law;
  const reference::Curves curves = {law.voce_stress_mpa,           law.voce_exponent,
                                    law.ludwik_stress_mpa,         law.ludwik_exponent,
                                    law.cowper_symonds_rate_per_s, law.cowper_symonds_exponent,
                                    law.johnson_cook_coefficient,  law.johnson_cook_reference_rate_per_s,
                                    scene.schedule.time_step};
  return {material.youngs_modulus,
          material.yield_stress,
          law.hardening_modulus_mpa,
          law.isotropic_fraction,
          material.density,
          material.plane_strain,
          curves};
}

/// By which the values of an element are found in the arrays of a state.
struct RowIndex {
  std::size_t first = 0;  // first element of its row
  std::size_t walls = 0;  // elements of the row
  std::size_t lane = 0;   // of the element in the row

  [[nodiscard]] std::size_t of(std::size_t per_element, std::size_t i) const {
    return first * per_element + i * walls + lane;
  }
};

/// REQUIRES: the element is of no rigid body.
const WallBlock& block_of(const Scene& scene, std::size_t element) {
  return *std::ranges::find_if(scene.walls.blocks, [&](const WallBlock& block) {
    return element < static_cast<std::size_t>(block.first_element + block.walls * block.elements);
  });
}

RowIndex row_index_of(const WallBlock& block, std::size_t element) {
  const auto walls = static_cast<std::size_t>(block.walls);
  const std::size_t lane = (element - static_cast<std::size_t>(block.first_element)) % walls;
  return {element - lane, walls, lane};
}

/// The forces of a unit that its elements keep, in the order of the oracle. `first`: row of its first element.
template <class T>
std::vector<double> end_forces_of(const FibreHistory<T>& memory, const RowIndex& first, bool is_pair) {
  const auto kept = [&](std::size_t element, std::size_t i) -> double {
    const RowIndex row = {first.first + element * first.walls, first.walls, first.lane};
    return memory.end_force[row.of(kEndForces, i)];
  };
  if (is_pair) {
    return {kept(0, 0), kept(1, 0), kept(0, 1), kept(0, 2), kept(1, 1)};
  }
  return {kept(0, 0), kept(0, 1), kept(0, 2)};
}

template <class T>
void read_history(const Scene& scene, const FibreHistory<T>& memory, std::size_t element,
                  reference::ElementHistory& history) {
  const WallBlock& block = block_of(scene, element);
  const RowIndex row = row_index_of(block, element);
  for (std::size_t f = 0; f < history.fibres.size(); ++f) {
    const std::size_t i = row.of(scene.fibre_count(), f);
    history.fibres[f].stress = memory.stress[i];
    if (!memory.back_stress.empty()) {
      history.fibres[f].back_stress = memory.back_stress[i];
      history.fibres[f].plastic_strain = memory.plastic_strain[i];
    }
  }
  if (memory.yielding.empty()) {
    return;
  }
  const std::size_t place = (row.first - static_cast<std::size_t>(block.first_element)) / row.walls;  // in the wall
  const bool is_second = block.has_pairs() && place % 2 == 1;                                         // of a pair
  if (!memory.shear.empty()) {
    history.borne.back()[1] = is_second ? -memory.shear[element] : memory.shear[element];
  }
  for (std::size_t section = 0; section < scene.section.section_count(); ++section) {
    const std::size_t i = row.of(scene.section.section_count(), section);
    history.borne[section] = {memory.section_axial[i], memory.section_moment[i]};
  }
  const auto has_bit = [bits = memory.yielding[element]](std::size_t bit) { return (bits >> bit & 1U) != 0; };
  for (std::size_t f = 0; f < history.yields.size(); ++f) {
    history.yields[f] = has_bit(f);
  }
  history.yielded_before = has_bit(8 * sizeof(typename FibreHistory<T>::Bits) - 1);
  if (!is_second) {
    const std::vector<double> forces = end_forces_of(memory, row, block.has_pairs());
    history.end_forces = Eigen::VectorXd::Map(forces.data(), static_cast<Eigen::Index>(forces.size()));
    history.owed = memory.owed[element] / material_of(scene, scene.elements[element]).modulus;
  }
}

/// False of the elements of rigid bodies, which have no blocks.
bool is_in_pair(const Scene& scene, std::size_t element) {
  const auto ends_after = [element](const WallBlock& block) {
    return static_cast<int>(element) < block.first_element + block.elements * block.walls;
  };
  const auto found = std::ranges::find_if(scene.walls.blocks, ends_after);
  return scene.section.force_based && found != scene.walls.blocks.end() && found->elements % 2 == 0;
}

}  // namespace

reference::ElementRule element_rule_of(const Scene& scene) {
  reference::ElementRule rule;
  rule.force_based = scene.section.force_based;
  rule.constant_area = scene.constant_area;
  rule.shears = !scene.walls.shear.empty();
  for (Eigen::Index i = 0; i < scene.section.along.size(); ++i) {
    rule.sections.push_back({scene.section.along[i], scene.section.along_weight[i]});
  }
  for (Eigen::Index j = 0; j < scene.section.offset.size(); ++j) {
    rule.points.push_back({scene.section.offset[j], scene.section.depth_weight[j]});
  }
  return rule;
}

reference::ElementData element_data_of(const Scene& scene, std::size_t element) {
  const Element& given = scene.elements[element];
  const double length = (scene.position[given.end] - scene.position[given.start]).norm();
  reference::ElementData data = {material_of(scene, given), given.thickness, scene.depth, length,
                                 is_in_pair(scene, element)};
  if (!scene.walls.shear.empty()) {
    // In plane stress, the moduli of bending and shear are E and E / 2 (1 + nu).
    constexpr double kPoissonsRatio = 0.33;
    data.shear = std::pow(given.thickness / length, 2) * (1.0 + kPoissonsRatio) / (6.0 * scene.section.shear_factor);
  }
  return data;
}

reference::ElementHistory element_history_of(const Scene& scene, const State& state, std::size_t element) {
  const Element& given = scene.elements[element];
  reference::ElementHistory history =
      reference::undeformed(element_rule_of(scene), scene.position[given.start], scene.position[given.end]);
  history.axis = state.axis[element];
  history.length = state.length[element];
  history.plastic_length /= state.shortening[element];
  scene.single_fibres ? read_history(scene, state.single_fibres, element, history)
                      : read_history(scene, state.fibres, element, history);
  return history;
}

std::vector<std::vector<int>> walls_of(const Scene& scene) {
  std::vector<std::vector<int>> walls;
  for (const WallBlock& block : scene.walls.blocks) {
    for (int w = 0; w < block.walls; ++w) {
      std::vector<int> wall;
      for (int j = 0; j < block.elements; ++j) {
        wall.push_back(block.first_element + j * block.walls + w);
      }
      walls.push_back(wall);
    }
  }
  return walls;
}

reference::Instant instant_of(const Scene& scene, const State& state) {
  reference::Instant instant;
  instant.motion = {{state.position.begin(), state.position.end()}, {state.velocity.begin(), state.velocity.end()}};
  instant.spin.assign(state.spin.begin(), state.spin.end());
  for (int e = 0; e < scene.rigid.first_element; ++e) {
    instant.elements.push_back(element_history_of(scene, state, static_cast<std::size_t>(e)));
  }
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    instant.force.push_back(state.internal_force[i] + state.contact_force[i].elastic + state.contact_force[i].viscous);
    if (!state.friction_force.empty()) {
      instant.force.back() += state.friction_force[i];
    }
  }
  instant.moment.assign(state.internal_moment.begin(), state.internal_moment.end());
  return instant;
}

reference::Lattice lattice_of(const Scene& scene) {
  reference::Lattice lattice;
  lattice.position = scene.position;
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const Element& element = scene.elements[e];
    lattice.segments.push_back(
        {element.start, element.end, element.thickness, material_of(scene, element), is_in_pair(scene, e)});
  }
  lattice.element_count = scene.rigid.first_element;
  lattice.walls = walls_of(scene);
  for (std::size_t body = 0; body < scene.rigid.count(); ++body) {
    lattice.bodies.push_back({scene.rigid.offset[body], scene.rigid.offset[body + 1]});
  }
  lattice.rule = element_rule_of(scene);
  lattice.depth = scene.depth;
  lattice.contact = {scene.contact.stiffness, scene.contact.damping_ratio, scene.contact.friction};
  const Plates& plates = scene.plates;
  lattice.plates = {plates.axis,      plates.impact_face, plates.support_face, plates.speed,
                    plates.ramp_time, plates.stiffness,   plates.friction};
  lattice.mass_damping = scene.mass_damping;
  lattice.time_step = scene.schedule.time_step;
  return lattice;
}

}  // namespace cellcrush
