#pragma once

#include <vector>

#include "core/reference/plane.h"
#include "core/reference/reference_fibre.h"

namespace cellcrush::reference {

/// A point of an integration rule; the weights of a rule sum to 1.
struct RulePoint {
  double position = 0.0;  ///< s along the element, 0 to 1, or y / h through its depth, -1/2 to 1/2
  double weight = 0.0;
};

/// What all elements of a lattice have in common.
struct ElementRule {
  bool force_based = false;
  bool constant_area = false;
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
};

/// History of an element.
struct ElementHistory {
  Vector axis;                ///< e_a
  double length = 0.0;        ///< l_a
  std::vector<Fibre> fibres;  ///< section by section

  // Of a force-based element.
  std::vector<Eigen::Vector2d> borne;  ///< of each section: n = N / A and m = M / (A gamma), MPa
  std::vector<bool> yields;            ///< of each fibre: whether it yielded in the newest step
  bool yielded_before = false;         ///< whether any fibre of the unit did in the step before that
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

/// What half of the thickness of an element of the length `length` has grown by (E5f), and its derivative by the
/// length.
struct Thickening {
  double growth = 0.0;  ///< mm
  double slope = 0.0;
};
Thickening thickening_of(const ElementRule& rule, const ElementData& data, double length);

/// Energy stored by the stresses, N mm (E10).
double elastic_energy(const ElementRule& rule, const ElementData& data, const ElementHistory& history);

}  // namespace cellcrush::reference
