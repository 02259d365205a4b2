#pragma once

#include "core/reference/reference_element.h"

namespace cellcrush::reference {

/// L of E5c: the length over which strains are taken.
double strained_length(const ElementRule& rule, const ElementData& data, double length);

/// V_0, mm^3.
double volume_of(const ElementData& data);

/// Area and modulus of an element of the length l, which may be squashed (E5c).
struct SquashedBar {
  double area;
  double modulus;
  double slope;  // d ln E_l / dl
};

SquashedBar squash(const ElementRule& rule, const ElementData& data, double length);

}  // namespace cellcrush::reference
