#include "core/reference/reference_element.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cellcrush::reference {
namespace {

/// An element over a step: its motion without the rigid part, and its section at the end.
struct DeformedElement {
  DeformedElement(const ElementRule& rule, const MovedElement& moved) : material(moved.data.material) {
    const ElementEnds& ends = moved.ends;
    const ElementHistory& history = *moved.history;
    const Vector span = ends.end - ends.start;
    length = span.norm();
    axis = span / length;
    mean_length = strained_length(rule, moved.data, 0.5 * (history.length + length));   // E5
    stretch = length - history.length;                                                  // Eq. 15
    const double turn = std::atan2(cross(history.axis, axis), history.axis.dot(axis));  // Eq. 9, E3
    turn_start = ends.turn_start - turn;                                                // Eq. 14, E4
    turn_end = ends.turn_end - turn;                                                    // Eq. 14, E4
    const SquashedBar bar = squash(rule, moved.data, length);
    area = bar.area;
    volume = volume_of(moved.data);
    material.modulus = bar.modulus;
    slope_of_modulus = bar.slope;
    const double thickness_before =
        moved.data.thickness + 2.0 * thickening_of(rule, moved.data, history.length).growth;  // E5f
    thickness = moved.data.thickness + 2.0 * thickening_of(rule, moved.data, length).growth;
    mean_thickness = 0.5 * (thickness_before + thickness);
  }

  Material material;        // with the modulus of the squashed element
  double thickness;         // h at the end of the step
  double mean_thickness;    // over the step
  double slope_of_modulus;  // d ln E_l / dl
  Vector axis;
  double length;
  double mean_length;  // L_m
  double stretch;      // Delta
  double turn_start;   // theta_1
  double turn_end;     // theta_2
  double area;
  double volume;
};

/// N / A, and M / (A gamma) at the start and the end, positive where the left side is stretched.
struct EndStresses {
  double axial;
  double left;
  double right;
};

/// Nodal forces of an element from its axial force and its end moments (Eq. 31, 32, E7). Where the modulus falls with
/// the length, the axial force has the derivative of the energy stored by these forces by the length (E5g).
ElementForces nodal_forces(const DeformedElement& element, double axial, double moment_start, double moment_end,
                           const EndStresses& stresses, double plastic_work) {
  const auto& [n, left, right] = stresses;
  const double energy =
      element.volume / (2.0 * element.material.modulus) * (n * n + (left * left + left * right + right * right) / 3.0);
  axial -= energy * element.slope_of_modulus;
  const double shear = -(moment_start + moment_end) / element.length;
  const Vector force_on_end = axial * element.axis + shear * turned_left(element.axis);
  return {force_on_end, moment_start, moment_end, plastic_work};
}

/// The displacement-based element: the curvature is linear (Eq. 27, E5a).
ElementForces respond_to_curvature(const ElementRule& rule, const DeformedElement& element, ElementHistory& history) {
  double axial = 0.0;
  double moment_start = 0.0;
  double moment_end = 0.0;
  double plastic_work = 0.0;
  for (std::size_t i = 0; i < rule.sections.size(); ++i) {
    const auto [s, section_weight] = rule.sections[i];
    const double curvature =
        ((4.0 - 6.0 * s) * element.turn_start + (2.0 - 6.0 * s) * element.turn_end) / element.mean_length;
    for (std::size_t j = 0; j < rule.points.size(); ++j) {
      const double arm = rule.points[j].position * element.thickness;  // y
      const double mean_arm = rule.points[j].position * element.mean_thickness;
      Fibre& fibre = history.fibres[i * rule.points.size() + j];
      const double strain = element.stretch / element.mean_length + mean_arm * curvature;  // E5
      const Flow flow = return_fibre(element.material, strain, fibre);
      const double part = section_weight * rule.points[j].weight;
      axial += part * element.area * fibre.stress;                                 // Eq. 28, E7
      moment_start += part * element.area * (4.0 - 6.0 * s) * arm * fibre.stress;  // Eq. 28, E7
      moment_end += part * element.area * (2.0 - 6.0 * s) * arm * fibre.stress;    // Eq. 28, E7
      plastic_work += part * element.volume * flow.work;                           // E10
    }
  }
  const double moment_area = element.area * element.thickness / std::sqrt(12.0);
  return nodal_forces(element, axial, moment_start, moment_end,
                      {axial / element.area, moment_start / moment_area, -moment_end / moment_area}, plastic_work);
}

/// One step of a unit of force-based elements (E5b, E5d). Its forces are the axial force of each element over A, then
/// the moment at each node over A gamma, which is positive where the left side stretches. The moment of an element is
/// linear between its nodes.
class ForceBasedStep {
 public:
  ForceBasedStep(const ElementRule& rule, const std::vector<DeformedElement>& elements,
                 const std::vector<MovedElement>& moved)
      : rule_(rule), elements_(elements), plastic_work_(elements.size(), 0.0) {
    for (const MovedElement& element : moved) {
      histories_.push_back(element.history);
    }
  }

  std::vector<ElementForces> advance() {
    const bool had_yielded = any_yields();
    move_fibres(strains_of_sections());
    for (ElementHistory* history : histories_) {
      history->yielded_before = had_yielded;
    }
    return nodal_forces_of(balance(no_strains(), yielding_sections(), borne()));
  }

 private:
  /// A section of the unit.
  struct Place {
    std::size_t element;
    std::size_t section;
  };
  /// n and m of a section, or its strain and gamma times its curvature.
  using OfSection = Eigen::Vector2d;
  /// Of all sections, element by element.
  using Flexibilities = std::vector<Eigen::Matrix2d>;

  [[nodiscard]] std::vector<Place> places() const {
    std::vector<Place> all;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      for (std::size_t i = 0; i < rule_.sections.size(); ++i) {
        all.push_back({e, i});
      }
    }
    return all;
  }

  /// gamma = h / sqrt(12), of the thickness over the step
  [[nodiscard]] double mean_gyration(std::size_t e) const { return elements_[e].mean_thickness / std::sqrt(12.0); }

  /// eta = y / gamma
  [[nodiscard]] double arm(std::size_t j) const { return rule_.points[j].position * std::sqrt(12.0); }

  [[nodiscard]] std::size_t fibre(const Place& at, std::size_t j) const { return at.section * rule_.points.size() + j; }

  /// Index of the moment at a node among the forces.
  [[nodiscard]] Eigen::Index moment(std::size_t node) const {
    return static_cast<Eigen::Index>(elements_.size() + node);
  }

  [[nodiscard]] Eigen::VectorXd no_strains() const { return Eigen::VectorXd::Zero(moment(elements_.size()) + 1); }

  /// What is conjugate to the forces: the stretches and the turns of the step over lengths. The turn at a node of two
  /// elements is that between them.
  [[nodiscard]] Eigen::VectorXd strains_of_unit() const {
    Eigen::VectorXd strains = no_strains();
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      strains[static_cast<Eigen::Index>(e)] = elements_[e].stretch / elements_[e].mean_length;
    }
    const std::size_t last = elements_.size() - 1;
    strains[moment(0)] = mean_gyration(0) * elements_.front().turn_start / elements_.front().mean_length;
    strains[moment(last + 1)] = -mean_gyration(last) * elements_.back().turn_end / elements_.back().mean_length;
    for (std::size_t node = 1; node <= last; ++node) {
      const DeformedElement& before = elements_[node - 1];
      const DeformedElement& after = elements_[node];
      const double over_length =
          0.5 * (mean_gyration(node - 1) / before.mean_length + mean_gyration(node) / after.mean_length);
      strains[moment(node)] = over_length * (after.turn_start - before.turn_end);
    }
    return strains;
  }

  /// Forces of a section from those of the unit.
  [[nodiscard]] Eigen::MatrixXd shape(const Place& at) const {
    const double s = rule_.sections[at.section].position;
    Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(2, no_strains().size());  // b_i
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
    const double hardening = material.hardening_modulus / (material.modulus + material.hardening_modulus);  // E_T / E
    const double tangent = 0.01 + hardening;
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
    for (const Place& at : places()) {
      all.push_back(flexibility(at, [](std::size_t) { return false; }));
    }
    return all;
  }

  /// Of sections whose fibres that yielded in the newest step are soft.
  [[nodiscard]] Flexibilities yielding_sections() const {
    Flexibilities all;
    for (const Place& at : places()) {
      all.push_back(flexibility(at, [&](std::size_t f) -> bool { return histories_[at.element]->yields[f]; }));
    }
    return all;
  }

  /// The same, but for those fibres which the sections' strains under the forces of an elastic unit would unload.
  [[nodiscard]] Flexibilities sections_ahead(const Eigen::VectorXd& elastic_forces) const {
    Flexibilities all;
    for (const Place& at : places()) {
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
  [[nodiscard]] Eigen::VectorXd balance(const Eigen::VectorXd& strains, const Flexibilities& sections,
                                        const std::vector<OfSection>& borne) const {
    Eigen::MatrixXd flexibility = Eigen::MatrixXd::Zero(strains.size(), strains.size());
    Eigen::VectorXd right = strains;
    const std::vector<Place> all = places();
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double weight = rule_.sections[all[k].section].weight;
      const Eigen::MatrixXd b = shape(all[k]);
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
    const Eigen::VectorXd strains = strains_of_unit();
    Flexibilities sections = elastic_sections();
    if (is_settled()) {
      const std::vector<OfSection> nothing(sections.size(), OfSection::Zero());  // what they bear is in balance
      return strains_under(balance(strains, sections, nothing), sections, nothing);
    }
    Eigen::VectorXd forces = balance(strains, sections, borne());
    if (any_yields()) {
      sections = sections_ahead(forces);
      forces = balance(strains, sections, borne());
    }
    return strains_under(forces, sections, borne());
  }

  /// Strains with which the sections go from what they bear to what the forces of the unit put on them.
  [[nodiscard]] std::vector<OfSection> strains_under(const Eigen::VectorXd& forces, const Flexibilities& sections,
                                                     const std::vector<OfSection>& borne) const {
    std::vector<OfSection> strains;
    const std::vector<Place> all = places();
    for (std::size_t k = 0; k < all.size(); ++k) {
      strains.push_back(sections[k] * (shape(all[k]) * forces - borne[k]));
    }
    return strains;
  }

  /// All fibres under the strains of their sections.
  void move_fibres(const std::vector<OfSection>& strains) {
    const std::vector<Place> all = places();
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Place& at = all[k];
      ElementHistory& history = *histories_[at.element];
      OfSection& borne = history.borne[at.section];
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

  /// A gamma of the section at a node: the mean of both elements that meet there.
  [[nodiscard]] double moment_area_at(std::size_t node) const {
    const DeformedElement& before = elements_[node == 0 ? node : node - 1];
    const DeformedElement& after = elements_[node == elements_.size() ? node - 1 : node];
    return 0.5 * (before.area * before.thickness + after.area * after.thickness) / std::sqrt(12.0);
  }

  [[nodiscard]] std::vector<ElementForces> nodal_forces_of(const Eigen::VectorXd& forces) const {
    std::vector<ElementForces> all;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const DeformedElement& element = elements_[e];
      const double axial = element.area * forces[static_cast<Eigen::Index>(e)];  // N = A n
      const double moment_start = moment_area_at(e) * forces[moment(e)];         // M = A gamma m
      const double moment_end = -moment_area_at(e + 1) * forces[moment(e + 1)];
      all.push_back(nodal_forces(element, axial, moment_start, moment_end,
                                 {axial / element.area, forces[moment(e)], forces[moment(e + 1)]},
                                 element.volume * plastic_work_[e]));
    }
    return all;
  }

  const ElementRule& rule_;
  const std::vector<DeformedElement>& elements_;
  std::vector<ElementHistory*> histories_;
  std::vector<double> plastic_work_;  // of each element, over its volume
};

}  // namespace

ElementHistory undeformed(const ElementRule& rule, const Vector& start, const Vector& end) {
  const Vector span = end - start;
  ElementHistory history;
  history.length = span.norm();
  history.axis = span / span.norm();
  history.fibres.resize(rule.sections.size() * rule.points.size());
  history.borne.assign(rule.sections.size(), Eigen::Vector2d::Zero());
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
  }
  return forces;
}

double elastic_energy(const ElementRule& rule, const ElementData& data, const ElementHistory& history) {
  const SquashedBar bar = squash(rule, data, history.length);
  double energy = 0.0;
  for (std::size_t f = 0; f < history.fibres.size(); ++f) {
    const double weight = rule.sections[f / rule.points.size()].weight * rule.points[f % rule.points.size()].weight;
    const double stress = history.fibres[f].stress;
    energy += weight * volume_of(data) * stress * stress / (2.0 * bar.modulus);  // E10
  }
  return energy;
}

}  // namespace cellcrush::reference
