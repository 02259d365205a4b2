#include "scene/run_cost.h"

#include <algorithm>
#include <cmath>

#include "lattice/lattice.h"
#include "lattice/list_walls.h"
#include "section/section_rule.h"

namespace cellcrush {
namespace {

/// Of an element-step, over one of the reference crush.
struct ElementCost {
  double elastic = 0.0;
  double flowing = 0.0;  ///< more, where all of the lattice is crushed at once
};

constexpr ElementCost kForceBased = {0.80, 1.24};
constexpr ElementCost kDisplacementBased = {0.42, 0.47};
constexpr int kManyElements = 8;                ///< per wall: away from its ends few of them yield
constexpr double kLessWithManyElements = 0.18;  ///< of `elastic`

// Times these.
constexpr double kInDoublePrecision = 1.33;
constexpr double kRigidJoints = 1.6;
constexpr double kMadeWalls = 1.12;  ///< walls outside blocks of sixteen
constexpr double kOneAtATime = 5.0;  ///< elements of other rules

// Of materials, beside that.
constexpr ElementCost kCurve = {3.5, 1.5};
constexpr ElementCost kPowerCurve = {6.7, 0.9};
constexpr ElementCost kRate = {18.0, 1.0};
constexpr ElementCost kLogarithmicRate = {4.6, 17.0};  ///< with or without a curve
constexpr ElementCost kFailure = {6.7, 7.6};

constexpr double kMeanOfLoads = 0.5;  ///< of their greatest speed: what strikes is slowed down
constexpr double kFlowSpeed = 0.49;   ///< V_f over the square root of yield stress over density

constexpr double kStep = 76.0;
constexpr double kSample = 1900.0;
constexpr double kElementOfSample = 0.3;

ElementCost operator+(const ElementCost& a, const ElementCost& b) {
  return {a.elastic + b.elastic, a.flowing + b.flowing};
}

ElementCost cost_of_law(const LawParameters& law) {
  ElementCost cost;
  if (law.has_curve()) {
    const bool is_power =
        law.ludwik_stress_mpa > 0.0 || law.hardening_table.beyond == HardeningTable::Beyond::power_law;
    cost = is_power ? kPowerCurve : kCurve;
  }
  if (law.johnson_cook_coefficient > 0.0) {
    cost = kLogarithmicRate;
  } else if (law.depends_on_rate()) {
    cost = {std::max(cost.elastic, kRate.elastic), std::max(cost.flowing, kRate.flowing)};
  }
  return law.fails() ? cost + kFailure : cost;
}

ElementCost cost_of_laws(const SceneSpec& spec) {
  ElementCost most;
  for (const MaterialSpec& material : material_specs_of(spec)) {
    const ElementCost cost = cost_of_law(material);
    if (cost.elastic + cost.flowing > most.elastic + most.flowing) most = cost;
  }
  return most;
}

double factor_of(const SceneSpec& spec) {
  const bool force_based = spec.section.formulation == SectionSpec::Formulation::force_based;
  const LatticeKind* kind = kind_of(spec);
  double factor = kind == nullptr ? 1.0 : kind->step_cost;
  factor *= has_made_walls(spec) || std::holds_alternative<NetworkWalls>(spec.lattice) ? kMadeWalls : 1.0;
  if (spec.section.rigid_joints) factor *= kRigidJoints;
  if (!has_known_counts(make_section_rule(spec.section))) factor *= kOneAtATime;
  const bool hardens = spec.material.hardening_modulus_mpa > 0.0 && !spec.material.has_curve();
  if (spec.numerics.fibre_precision == NumericsSpec::FibrePrecision::double_precision || (force_based && hardens)) {
    factor *= kInDoublePrecision;
  }
  return factor;
}

}  // namespace

double reference_steps(const SceneSpec& spec, const MeshMeasures& mesh, const RunPlan& plan) {
  const bool force_based = spec.section.formulation == SectionSpec::Formulation::force_based;
  ElementCost cost = force_based ? kForceBased : kDisplacementBased;
  if (force_based && spec.elements_per_wall.value_or(1) >= kManyElements) cost.elastic -= kLessWithManyElements;
  const double factor = factor_of(spec);
  cost = ElementCost{factor * cost.elastic, factor * cost.flowing} + cost_of_laws(spec);
  const double speed = plan.plates.present ? plan.plates.speed : kMeanOfLoads * mesh.approach_speed;
  const double flow_speed = kFlowSpeed * std::sqrt(mesh.material.yield_stress / mesh.material.density);
  const double flowing = speed * speed / (speed * speed + flow_speed * flow_speed);
  const auto elements = static_cast<double>(mesh.element_count);
  const auto steps = static_cast<double>(plan.schedule.step_count);
  const double samples = steps / static_cast<double>(std::max<std::int64_t>(plan.schedule.sample_interval, 1));
  return steps * (elements * (cost.elastic + flowing * cost.flowing) + kStep) +
         samples * (kSample + elements * kElementOfSample);
}

}  // namespace cellcrush
