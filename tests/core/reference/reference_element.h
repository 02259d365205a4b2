#pragma once

#include <Eigen/Core>
#include <vector>

namespace cellcrush::reference {

using Vector = Eigen::Vector2d;

inline double cross(const Vector& a, const Vector& b) { return a.x() * b.y() - a.y() * b.x(); }
inline Vector turned_left(const Vector& a) { return {-a.y(), a.x()}; }
inline Vector turned_right(const Vector& a) { return {a.y(), -a.x()}; }

/// Terms of the yield stress beside a linear one (E6d), and its factor (E6e). MPa, 1/s; 0: no such term.
struct Curves {
  double voce_stress = 0.0;
  double voce_exponent = 0.0;
  double ludwik_stress = 0.0;
  double ludwik_exponent = 0.0;
  double symonds_rate = 0.0;
  double symonds_exponent = 0.0;
  double johnson_coefficient = 0.0;
  double johnson_rate = 0.0;
  double step = 0.0;  ///< s, over which a strain increment is made
};

/// Mixed hardening: bilinear, or with curves. MPa.
struct Material {
  double modulus = 0.0;             ///< E
  double yield_stress = 0.0;        ///< sigma_y
  double hardening_modulus = 0.0;   ///< H
  double isotropic_fraction = 1.0;  ///< beta
  double density = 0.0;             ///< rho, tonne / mm^3
  bool plane_strain = false;        ///< otherwise plane stress
  Curves curves;
};

/// History of a fibre. MPa.
struct Fibre {
  double stress = 0.0;          ///< sigma
  double back_stress = 0.0;     ///< alpha
  double plastic_strain = 0.0;  ///< ep, accumulated
};

/// What a fibre does in a step.
struct Flow {
  double strain = 0.0;  ///< plastic strain increment, with its sign
  double work = 0.0;    ///< plastic work, MPa: over the mean of the stresses at which the flow begins and ends (E10)
};

/// Return mapping of a fibre under a strain increment (Eq. 33-39).
Flow return_fibre(const Material& material, double strain_increment, Fibre& fibre);

/// A point of an integration rule; the weights of a rule sum to 1.
struct RulePoint {
  double position = 0.0;  ///< s along the element, 0 to 1, or y / h through its depth, -1/2 to 1/2
  double weight = 0.0;
};

/// What all elements of a lattice have in common.
struct ElementRule {
  bool force_based = false;
  bool constant_area = false;
  bool shears = false;  ///< of force-based elements (E5i)
  std::vector<RulePoint> sections;
  std::vector<RulePoint> points;  ///< of each section
};

/// What does not change over a run. mm.
struct ElementData {
  Material material;
  double thickness = 0.0;          ///< h
  double depth = 0.0;              ///< b
  double undeformed_length = 0.0;  ///< l_0
  bool in_pair = false;            ///< solved with its neighbour (E5b)
  double shear = 0.0;              ///< phi of E5i
};

/// History of an element.
struct ElementHistory {
  Vector axis;                  ///< e_a
  double length = 0.0;          ///< l_a
  double plastic_length = 0.0;  ///< L, without elastic strain (E5c)
  std::vector<Fibre> fibres;    ///< section by section

  // Of a force-based element.
  /// Of each section: n = N / A and m = M / (A gamma), MPa. Of an element that shears, then 0 and what its shear bears:
  /// m at its start less that at its end.
  std::vector<Eigen::Vector2d> borne;
  std::vector<bool> yields;     ///< of each fibre: whether it yielded in the newest step
  bool yielded_before = false;  ///< whether any fibre of the unit did in the step before that
  Eigen::VectorXd end_forces;   ///< of the unit, at its first element (E5h)
  double owed = 0.0;            ///< MPa, at its first element: what the work of the end forces misses
};
ElementHistory undeformed(const ElementRule& rule, const Vector& start, const Vector& end);

/// Where the ends of an element are, and by how much they turned in the step.
struct ElementEnds {
  Vector start;
  Vector end;
  double turn_start = 0.0;
  double turn_end = 0.0;
};

/// An element that is to make a step.
struct MovedElement {
  ElementData data;
  ElementEnds ends;
  ElementHistory* history = nullptr;
};

/// Forces of the element's resistance (Eq. 28-32), N and N mm. The force on the start is the reverse.
struct ElementForces {
  Vector on_end;
  double moment_on_start = 0.0;
  double moment_on_end = 0.0;
  double plastic_work = 0.0;  ///< of the step, N mm
};

/// The elements of a wall that are solved together, from the wall's start to its end (E5b): the force-based elements of
/// a wall with an even number of them two by two, all others one by one. The common node of two has no rotation.
std::vector<std::vector<int>> units_of(const ElementRule& rule, const std::vector<int>& wall);

/// A step of the elements of a unit: Eq. 7-15 and 22-32. The turn of the common node of two is not used.
std::vector<ElementForces> advance_unit(const ElementRule& rule, const std::vector<MovedElement>& unit);

/// What half of the thickness of an element has grown by (E5f), and its derivative by the length: L in bending, l in
/// contact.
struct Thickening {
  double growth = 0.0;  ///< mm
  double slope = 0.0;
};
Thickening thickening_of(const ElementRule& rule, const ElementData& data, double length);

/// Energy stored by the stresses, N mm (E10).
double elastic_energy(const ElementRule& rule, const ElementData& data, const ElementHistory& history);

/// The length over which strains are taken (E5).
double strained_length(const ElementRule& rule, const ElementData& data, double plastic_length);

/// V_0, mm^3.
double volume_of(const ElementData& data);

/// E_l of E5c, MPa.
double squashed_modulus(const ElementRule& rule, const ElementData& data, double plastic_length);

}  // namespace cellcrush::reference
