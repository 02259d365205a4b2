#include "core/reference/reference_element.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cellcrush::reference {
namespace {

/// An element over a step: its motion without the rigid part, and what follows from L at its start.
struct DeformedElement {
  DeformedElement(const ElementRule& rule, const MovedElement& moved)
      : data(moved.data), material(moved.data.material) {
    const ElementEnds& ends = moved.ends;
    const ElementHistory& history = *moved.history;
    const Vector span = ends.end - ends.start;
    length = span.norm();
    axis = span / length;
    plastic_length = history.plastic_length;
    strained = strained_length(rule, moved.data, plastic_length);                       // E5
    stretch = length - history.length;                                                  // Eq. 15
    const double turn = std::atan2(cross(history.axis, axis), history.axis.dot(axis));  // Eq. 9, E3
    turn_start = ends.turn_start - turn;                                                // Eq. 14, E4
    turn_end = ends.turn_end - turn;                                                    // Eq. 14, E4
    volume = volume_of(moved.data);
    material.modulus = squashed_modulus(rule, moved.data, plastic_length);
    thickness = moved.data.thickness + 2.0 * thickening_of(rule, moved.data, plastic_length).growth;  // E5f
  }

  /// Takes the elastic strain of the axial stress n off the length (E5c): the new L, and the area.
  void shorten(const ElementRule& rule, double n) {
    const double yield = data.material.yield_stress;
    double elastic_strain = n / data.material.modulus;
    if (plastic_length < 0.95 * data.undeformed_length) {
      const double modulus = std::max(material.modulus, std::min(20.0 * yield, data.material.modulus));
      elastic_strain = std::max(n / modulus + yield * (1.0 / modulus - 1.0 / data.material.modulus), -0.5);
    }
    plastic_length = std::min(length / (1.0 + elastic_strain), data.undeformed_length);
    area = volume / strained_length(rule, data, plastic_length);
  }

  ElementData data;
  Material material;  // with the modulus of the squashed element
  double thickness;   // h
  Vector axis;
  double length;
  double plastic_length;  // L: at the start of the step, then at its end
  double strained;        // over which strains are taken
  double stretch;         // Delta
  double turn_start;      // theta_1
  double turn_end;        // theta_2
  double area = 0.0;      // at the end of the step
  double volume;
};

/// N / A, and M / (A gamma) at the start and the end, positive where the left side is stretched.
struct EndStresses {
  double axial;
  double left;
  double right;
};

/// Nodal forces of an element from its axial force and its end moments (Eq. 31, 32, E7). What these forces store as the
/// modulus falls is taken from the plastic work (E5g).
ElementForces nodal_forces(const ElementRule& rule, const DeformedElement& element, double axial, double moment_start,
                           double moment_end, const EndStresses& stresses, double plastic_work) {
  const auto& [n, left, right] = stresses;
  const double of_shear = element.data.shear * (left - right) * (left - right);  // E5i
  const double squares = n * n + (left * left + left * right + right * right) / 3.0 + of_shear;
  const double modulus = squashed_modulus(rule, element.data, element.plastic_length);
  const double stored = element.volume * squares / 2.0 * (1.0 / modulus - 1.0 / element.material.modulus);
  const double shear = -(moment_start + moment_end) / element.length;
  const Vector force_on_end = axial * element.axis + shear * turned_left(element.axis);
  return {force_on_end, moment_start, moment_end, plastic_work - stored};
}

/// The displacement-based element: the curvature is linear (Eq. 27, E5a).
ElementForces respond_to_curvature(const ElementRule& rule, DeformedElement& element, ElementHistory& history) {
  double axial = 0.0;  // over A, as the moments
  double moment_start = 0.0;
  double moment_end = 0.0;
  double plastic_work = 0.0;
  for (std::size_t i = 0; i < rule.sections.size(); ++i) {
    const auto [s, section_weight] = rule.sections[i];
    const double curvature =
        ((4.0 - 6.0 * s) * element.turn_start + (2.0 - 6.0 * s) * element.turn_end) / element.strained;
    for (std::size_t j = 0; j < rule.points.size(); ++j) {
      const double arm = rule.points[j].position * element.thickness;  // y
      Fibre& fibre = history.fibres[i * rule.points.size() + j];
      const double strain = element.stretch / element.strained + arm * curvature;  // E5
      const Flow flow = return_fibre(element.material, strain, fibre);
      const double part = section_weight * rule.points[j].weight;
      axial += part * fibre.stress;                                 // Eq. 28, E7
      moment_start += part * (4.0 - 6.0 * s) * arm * fibre.stress;  // Eq. 28, E7
      moment_end += part * (2.0 - 6.0 * s) * arm * fibre.stress;    // Eq. 28, E7
      plastic_work += part * element.volume * flow.work;            // E10
    }
  }
  element.shorten(rule, axial);
  const double gyration = element.thickness / std::sqrt(12.0);
  return nodal_forces(rule, element, element.area * axial, element.area * moment_start, element.area * moment_end,
                      {axial, moment_start / gyration, -moment_end / gyration}, plastic_work);
}

/// One step of a unit of force-based elements (E5b, E5d). Its forces are the axial force of each element over A, then
/// the moment at each node over A gamma, which is positive where the left side stretches. The moment of an element is
/// linear between its nodes.
class ForceBasedStep {
 public:
  ForceBasedStep(const ElementRule& rule, std::vector<DeformedElement>& elements,
                 const std::vector<MovedElement>& moved)
      : rule_(rule), elements_(elements), plastic_work_(elements.size(), 0.0) {
    for (const MovedElement& element : moved) {
      histories_.push_back(element.history);
    }
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      for (std::size_t i = 0; i < rule_.sections.size(); ++i) {
        places_.push_back({e, i});
      }
      if (rule_.shears) {
        places_.push_back({e, rule_.sections.size()});
      }
    }
  }

  std::vector<ElementForces> advance() {
    if (histories_.front()->end_forces.size() == 0) {
      histories_.front()->end_forces = no_strains();
    }
    const bool had_yielded = any_yields();
    const std::vector<OfSection> before = borne();
    const std::vector<OfSection> strains = strains_of_sections();
    move_fibres(strains);
    for (ElementHistory* history : histories_) {
      history->yielded_before = had_yielded;
    }
    UnitForces forces = balance(no_strains(), yielding_sections(), borne());
    if (had_yielded || any_yields()) {
      forces += work_exact_correction(forces, before, strains);
    }
    histories_.front()->end_forces = forces;
    return nodal_forces_of(forces);
  }

 private:
  /// A section of the unit, or after those of an element its shear: the moment of that is the difference of the moments
  /// at the nodes, its flexibility phi / E_l (E5i).
  struct Place {
    std::size_t element;
    std::size_t section;
  };
  /// n and m of a section, or its strain and gamma times its curvature.
  using OfSection = Eigen::Vector2d;
  /// Of all sections, element by element.
  using Flexibilities = std::vector<Eigen::Matrix2d>;
  /// n of each element, then m at each node, of a unit of one or two elements; or what is conjugate to them.
  using UnitForces = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 5, 1>;
  using Shape = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 5>;
  using UnitFlexibility = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 5, 5>;

  /// gamma = h / sqrt(12)
  [[nodiscard]] double gyration(std::size_t e) const { return elements_[e].thickness / std::sqrt(12.0); }

  /// eta = y / gamma
  [[nodiscard]] double arm(std::size_t j) const { return rule_.points[j].position * std::sqrt(12.0); }

  [[nodiscard]] std::size_t fibre(const Place& at, std::size_t j) const { return at.section * rule_.points.size() + j; }

  /// Index of the moment at a node among the forces.
  [[nodiscard]] Eigen::Index moment(std::size_t node) const {
    return static_cast<Eigen::Index>(elements_.size() + node);
  }

  [[nodiscard]] UnitForces no_strains() const { return UnitForces::Zero(moment(elements_.size()) + 1); }

  /// What is conjugate to the forces: the stretches and the turns of the step over lengths. The turn at a node of two
  /// elements is that between them.
  [[nodiscard]] UnitForces strains_of_unit() const {
    UnitForces strains = no_strains();
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      strains[static_cast<Eigen::Index>(e)] = elements_[e].stretch / elements_[e].strained;
    }
    const std::size_t last = elements_.size() - 1;
    strains[moment(0)] = gyration(0) * elements_.front().turn_start / elements_.front().strained;
    strains[moment(last + 1)] = -gyration(last) * elements_.back().turn_end / elements_.back().strained;
    for (std::size_t node = 1; node <= last; ++node) {
      const DeformedElement& before = elements_[node - 1];
      const DeformedElement& after = elements_[node];
      const double over_length = 0.5 * (gyration(node - 1) / before.strained + gyration(node) / after.strained);
      strains[moment(node)] = over_length * (after.turn_start - before.turn_end);
    }
    return strains;
  }

  [[nodiscard]] bool is_shear(const Place& at) const { return at.section == rule_.sections.size(); }
  [[nodiscard]] double weight_of(const Place& at) const {
    return is_shear(at) ? 1.0 : rule_.sections[at.section].weight;
  }

  /// Forces of a section from those of the unit.
  [[nodiscard]] Shape shape(const Place& at) const {
    Shape shape = Shape::Zero(2, no_strains().size());  // b_i
    if (is_shear(at)) {
      shape(1, moment(at.element)) = 1.0;
      shape(1, moment(at.element + 1)) = -1.0;
      return shape;
    }
    const double s = rule_.sections[at.section].position;
    shape(0, static_cast<Eigen::Index>(at.element)) = 1.0;
    shape(1, moment(at.element)) = 1.0 - s;
    shape(1, moment(at.element + 1)) = s;
    return shape;
  }

  [[nodiscard]] std::vector<OfSection> borne() const {
    std::vector<OfSection> all;
    for (const ElementHistory* history : histories_) {
      all.insert(all.end(), history->borne.begin(), history->borne.end());
    }
    return all;
  }

  /// Flexibility of a section in which some fibres are soft. The others make up the rest of an elastic section, whose
  /// stiffness is E_l times the unit matrix.
  template <class IsSoft>
  [[nodiscard]] Eigen::Matrix2d flexibility(const Place& at, const IsSoft& is_soft) const {
    const Material& material = elements_[at.element].material;
    if (is_shear(at)) {
      return Eigen::Vector2d(0.0, elements_[at.element].data.shear / material.modulus).asDiagonal();
    }
    const double hardening = material.hardening_modulus / (material.modulus + material.hardening_modulus);  // E_T / E
    const double tangent = 0.02 + hardening;
    Eigen::Matrix2d stiffness = Eigen::Matrix2d::Identity();
    for (std::size_t j = 0; j < rule_.points.size(); ++j) {
      if (is_soft(fibre(at, j))) {
        const Eigen::Vector2d of_strains(1.0, arm(j));
        stiffness -= rule_.points[j].weight * (1.0 - tangent) * of_strains * of_strains.transpose();
      }
    }
    return (material.modulus * stiffness).inverse();
  }

  [[nodiscard]] Flexibilities elastic_sections() const {
    Flexibilities all;
    for (const Place& at : places_) {
      all.push_back(flexibility(at, [](std::size_t) { return false; }));
    }
    return all;
  }

  /// Of sections whose fibres that yielded in the newest step are soft.
  [[nodiscard]] Flexibilities yielding_sections() const {
    Flexibilities all;
    for (const Place& at : places_) {
      all.push_back(flexibility(at, [&](std::size_t f) -> bool { return histories_[at.element]->yields[f]; }));
    }
    return all;
  }

  /// The same, but for those fibres which the sections' strains under the forces of an elastic unit would unload.
  [[nodiscard]] Flexibilities sections_ahead(const UnitForces& elastic_forces) const {
    Flexibilities all;
    for (const Place& at : places_) {
      const ElementHistory& history = *histories_[at.element];
      const OfSection strains =
          (shape(at) * elastic_forces - history.borne[at.section]) / elements_[at.element].material.modulus;
      all.push_back(flexibility(at, [&](std::size_t f) {
        const Fibre& fibre = history.fibres[f];
        const double strain = strains[0] + arm(f % rule_.points.size()) * strains[1];
        return history.yields[f] && (fibre.stress - fibre.back_stress) * strain > 0.0;
      }));
    }
    return all;
  }

  /// Forces with which the sections take up the strains of the unit, and what they bear out of balance:
  /// sum W b^T f b Q = q + sum W b^T f S (E5b).
  [[nodiscard]] UnitForces balance(const UnitForces& strains, const Flexibilities& sections,
                                   const std::vector<OfSection>& borne) const {
    UnitFlexibility flexibility = UnitFlexibility::Zero(strains.size(), strains.size());
    UnitForces right = strains;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const double weight = weight_of(places_[k]);
      const Shape b = shape(places_[k]);
      flexibility += weight * b.transpose() * sections[k] * b;
      right += weight * b.transpose() * sections[k] * borne[k];
    }
    return flexibility.fullPivLu().solve(right);
  }

  [[nodiscard]] bool any_yields() const {
    return std::ranges::any_of(histories_, [](const ElementHistory* history) {
      return std::ranges::find(history->yields, true) != history->yields.end();
    });
  }

  [[nodiscard]] bool is_settled() const {
    return !any_yields() &&
           std::ranges::none_of(histories_, [](const ElementHistory* history) { return history->yielded_before; });
  }

  /// Strains of all sections in the step.
  [[nodiscard]] std::vector<OfSection> strains_of_sections() const {
    const UnitForces strains = strains_of_unit();
    Flexibilities sections = elastic_sections();
    if (is_settled()) {
      const std::vector<OfSection> nothing(sections.size(), OfSection::Zero());  // what they bear is in balance
      return strains_under(balance(strains, sections, nothing), sections, nothing);
    }
    UnitForces forces = balance(strains, sections, borne());
    if (any_yields()) {
      sections = sections_ahead(forces);
      forces = balance(strains, sections, borne());
    }
    return strains_under(forces, sections, borne());
  }

  /// Strains with which the sections go from what they bear to what the forces of the unit put on them.
  [[nodiscard]] std::vector<OfSection> strains_under(const UnitForces& forces, const Flexibilities& sections,
                                                     const std::vector<OfSection>& borne) const {
    std::vector<OfSection> strains;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      strains.push_back(sections[k] * (shape(places_[k]) * forces - borne[k]));
    }
    return strains;
  }

  /// All fibres under the strains of their sections.
  void move_fibres(const std::vector<OfSection>& strains) {
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Place& at = places_[k];
      ElementHistory& history = *histories_[at.element];
      OfSection& borne = history.borne[at.section];
      if (is_shear(at)) {
        borne[1] += strains[k][1] * elements_[at.element].material.modulus / elements_[at.element].data.shear;
        continue;
      }
      borne.setZero();
      for (std::size_t j = 0; j < rule_.points.size(); ++j) {
        Fibre& moved = history.fibres[fibre(at, j)];
        const Flow flow = return_fibre(elements_[at.element].material, strains[k][0] + arm(j) * strains[k][1], moved);
        history.yields[fibre(at, j)] = flow.strain != 0.0;
        const double weight = rule_.points[j].weight;
        borne += weight * moved.stress * OfSection(1.0, arm(j));
        plastic_work_[at.element] += rule_.sections[at.section].weight * weight * flow.work;  // E10
      }
    }
  }

  /// Half of what the work of the sections is more than that of the end forces, as a multiple of the forces with which
  /// an elastic unit takes up the strains; the rest is owed to the next step (E5h).
  [[nodiscard]] UnitForces work_exact_correction(const UnitForces& forces, const std::vector<OfSection>& borne_before,
                                                 const std::vector<OfSection>& strains) const {
    ElementHistory& history = *histories_.front();
    const std::vector<OfSection> borne_now = borne();
    double work = 0.0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      work += weight_of(places_[k]) * (borne_before[k] + borne_now[k]).dot(strains[k]);
    }
    const UnitForces ends = strains_of_unit();
    const std::vector<OfSection> nothing(places_.size(), OfSection::Zero());
    const UnitForces elastic = balance(ends, elastic_sections(), nothing);
    const double missing = work - (history.end_forces + forces).dot(ends) + history.owed;
    const double whole = elastic.dot(ends);
    const Material& material = elements_.front().data.material;
    const double least = 1e-9 * material.yield_stress * material.yield_stress / material.modulus;
    const double share = std::clamp(0.5 * missing / std::max(whole, least), -0.3, 0.3);
    history.owed = missing - share * whole;
    return share * elastic;
  }

  /// A gamma of the section at a node: the mean of both elements that meet there.
  [[nodiscard]] double moment_area_at(std::size_t node) const {
    const DeformedElement& before = elements_[node == 0 ? node : node - 1];
    const DeformedElement& after = elements_[node == elements_.size() ? node - 1 : node];
    return 0.5 * (before.area * before.thickness + after.area * after.thickness) / std::sqrt(12.0);
  }

  [[nodiscard]] std::vector<ElementForces> nodal_forces_of(const UnitForces& forces) {
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      elements_[e].shorten(rule_, forces[static_cast<Eigen::Index>(e)]);
    }
    std::vector<ElementForces> all;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const DeformedElement& element = elements_[e];
      const double axial = element.area * forces[static_cast<Eigen::Index>(e)];  // N = A n
      const double moment_start = moment_area_at(e) * forces[moment(e)];         // M = A gamma m
      const double moment_end = -moment_area_at(e + 1) * forces[moment(e + 1)];
      all.push_back(nodal_forces(rule_, element, axial, moment_start, moment_end,
                                 {axial / element.area, forces[moment(e)], forces[moment(e + 1)]},
                                 element.volume * plastic_work_[e]));
    }
    return all;
  }

  const ElementRule& rule_;
  std::vector<DeformedElement>& elements_;
  std::vector<ElementHistory*> histories_;
  std::vector<Place> places_;         // of all sections
  std::vector<double> plastic_work_;  // of each element, over its volume
};

}  // namespace

ElementHistory undeformed(const ElementRule& rule, const Vector& start, const Vector& end) {
  const Vector span = end - start;
  ElementHistory history;
  history.length = span.norm();
  history.plastic_length = history.length;
  history.axis = span / span.norm();
  history.fibres.resize(rule.sections.size() * rule.points.size());
  history.borne.assign(rule.sections.size() + (rule.shears ? 1 : 0), Eigen::Vector2d::Zero());
  history.yields.assign(history.fibres.size(), false);
  return history;
}

std::vector<std::vector<int>> units_of(const ElementRule& rule, const std::vector<int>& wall) {
  std::vector<std::vector<int>> units;
  const bool by_twos = rule.force_based && wall.size() % 2 == 0;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    if (by_twos && k % 2 == 1) {
      units.back().push_back(wall[k]);
    } else {
      units.push_back({wall[k]});
    }
  }
  return units;
}

std::vector<ElementForces> advance_unit(const ElementRule& rule, const std::vector<MovedElement>& unit) {
  std::vector<DeformedElement> elements;
  for (MovedElement moved : unit) {
    if (unit.size() == 2) {
      (elements.empty() ? moved.ends.turn_end : moved.ends.turn_start) = 0.0;  // of the common node
    }
    elements.emplace_back(rule, moved);
  }
  const std::vector<ElementForces> forces =
      rule.force_based ? ForceBasedStep(rule, elements, unit).advance()
                       : std::vector{respond_to_curvature(rule, elements.front(), *unit.front().history)};
  for (std::size_t e = 0; e < unit.size(); ++e) {
    unit[e].history->axis = elements[e].axis;
    unit[e].history->length = elements[e].length;
    unit[e].history->plastic_length = elements[e].plastic_length;
  }
  return forces;
}

double elastic_energy(const ElementRule& rule, const ElementData& data, const ElementHistory& history) {
  const double modulus = squashed_modulus(rule, data, history.plastic_length);
  double energy = 0.0;
  for (std::size_t f = 0; f < history.fibres.size(); ++f) {
    const double weight = rule.sections[f / rule.points.size()].weight * rule.points[f % rule.points.size()].weight;
    const double stress = history.fibres[f].stress;
    energy += weight * volume_of(data) * stress * stress / (2.0 * modulus);  // E10
  }
  if (rule.shears) {
    energy += data.shear * volume_of(data) * std::pow(history.borne.back()[1], 2) / (2.0 * modulus);  // E5i
  }
  return energy;
}

}  // namespace cellcrush::reference
