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
  double no_moment = 6e-10;    ///< moments over A h that count as rounding, of sigma_y
  double no_softening = 1e-6;  ///< flexibility of a section beyond 1 that counts as rounding
  std::vector<RulePoint> sections;
  std::vector<RulePoint> points;  ///< of each section
};

/// What does not change over a run. mm.
struct ElementData {
  Material material;
  double thickness = 0.0;          ///< h
  double depth = 0.0;              ///< b
  double undeformed_length = 0.0;  ///< l_0
};

/// History of an element.
struct ElementHistory {
  Vector axis;                      ///< e_a
  double length = 0.0;              ///< l_a
  std::vector<Fibre> fibres;        ///< section by section
  std::vector<double> flexibility;  ///< of each section, 1 / t_i
  std::vector<double> shortfall;    ///< of each section, u_i over A h, MPa
  double moment_start = 0.0;        ///< m_1 over A h, MPa
  double moment_end = 0.0;          ///< m_2 over A h, MPa
};
ElementHistory undeformed(const ElementRule& rule, const Vector& start, const Vector& end);

/// Where the ends of an element are, and by how much they turned in the step.
struct ElementEnds {
  Vector start;
  Vector end;
  double turn_start = 0.0;
  double turn_end = 0.0;
};

/// Forces of the element's resistance (Eq. 28-32), N and N mm. The force on the start is the reverse.
struct ElementForces {
  Vector on_end;
  double moment_on_start = 0.0;
  double moment_on_end = 0.0;
  double plastic_work = 0.0;  ///< of the step, N mm
};

/// A step of an element: Eq. 7-15 and 22-32.
ElementForces advance_element(const ElementRule& rule, const ElementData& data, const ElementEnds& ends,
                              ElementHistory& history);

/// Energy stored by the stresses, N mm (E10).
double elastic_energy(const ElementRule& rule, const ElementData& data, const ElementHistory& history);

}  // namespace cellcrush::reference
