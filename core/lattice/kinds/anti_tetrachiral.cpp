#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fields/field_checker.h"
#include "lattice/lattice.h"
#include "lattice/layout.h"

// Rings of radius r whose centres are L apart along x and y, joined by straight ligaments that touch both rings from
// the same side, above and below, left and right in turn. Neighbouring rings are mirror images, and turn in opposite
// senses: auxetic. A ring is four arcs between its highest, rightmost, lowest and leftmost points, of which a ring
// within the lattice bears a ligament each.
//
// Closed forms. A ligament lies between mirror images, so that it bears no shear force but a pull and a moment that is
// the same all along. Pulls F along x and G along y act on a ring as two parts: (F + G) / 2 turns it, and bends all
// ligaments alike; (F - G) / 2 shears it, and makes an ellipse of it. In an arc without loads m - r n is constant (n
// axial force, m moment): 0 in a turn, in a shear that of least energy. With the energies A ((F + G) / 2)^2 and B ((F -
// G) / 2)^2 of a cell, E* = 2 / (A + B) and nu* = (B - A) / (A + B); exact for thin rings and beams without shear.
// Rigid rings would give E t^3 / (6 r^2 L) and -1. Collapse: the ligaments yield in bending all along, which lets the
// rings turn; half of their moments at most act in the rings.
namespace cellcrush {
namespace {

constexpr const char* kRadius = "ring_radius_mm";

/// Elements of a wall of mean length that give so many to the quarter of a ring, in a large lattice. Numbers may be
/// missing or not valid.
int elements_for(int of_quarter, const RegularLattice& lattice) {
  constexpr int kMost = 64;
  const double quarter = 0.5 * std::numbers::pi * own_number(lattice, kRadius);
  if (!(quarter > 0.0)) return kMost;
  const double mean = (4.0 * quarter + 2.0 * lattice.side_mm.value_or(0.0)) / 6.0;
  return static_cast<int>(std::min(1.0 * kMost, std::ceil(of_quarter * mean / quarter)));
}

void check_rings(const SceneSpec& spec, double side, FieldChecker& check) {
  const RegularLattice& lattice = *regular_lattice_of(spec);
  const double thickness = lattice.wall_thickness_mm.value_or(0.0);
  const double radius = own_number(lattice, kRadius);
  if (std::isfinite(side) && side - 2.0 * radius < thickness) {
    check.add("lattice.anti_tetrachiral.ring_radius_mm", to_text(radius), "makes neighbouring rings overlap.",
              "Give at most " + to_text(0.5 * (side - thickness)) + ".");
  }
  constexpr int kFewest = 2;  // of a quarter of a ring
  if (std::isfinite(side) && *spec.elements_per_wall < elements_for(kFewest, lattice)) {
    check.add("elements_per_wall", std::to_string(*spec.elements_per_wall), "makes squares of the rings.",
              "Give at least " + std::to_string(elements_for(kFewest, lattice)) + ", or a greater ring_radius_mm.");
  }
}

enum Place { kTop, kRight, kBottom, kLeft, kPlaces };

Layout lay_out_rings(const SceneSpec& spec) {
  const RegularLattice& lattice = *regular_lattice_of(spec);
  const double radius = own_number(lattice, kRadius);
  const double rise = (1.0 - 0.5 * std::numbers::sqrt2) * radius;
  const Vector2 arm[kPlaces] = {{0.0, radius}, {radius, 0.0}, {0.0, -radius}, {-radius, 0.0}};
  const int across = *lattice.columns + 1;
  const int up = *lattice.rows + 1;
  Layout layout;
  const auto add_wall = [&](int start, int end, double its_rise) {
    layout.walls.push_back({start, end, *lattice.wall_thickness_mm});
    layout.walls.back().rise = its_rise;
  };
  for (int y = 0; y < up; ++y) {
    for (int x = 0; x < across; ++x) {
      const int first = kPlaces * (y * across + x);
      for (int place = 0; place < kPlaces; ++place) {
        layout.joints.push_back(Vector2(x, y) * *lattice.side_mm + Vector2::Constant(radius) + arm[place]);
        add_wall(first + place, first + (place + 1) % kPlaces, rise);
      }
      const bool is_even = (x + y) % 2 == 0;
      if (x > 0) {
        const int place = is_even ? kBottom : kTop;
        add_wall(first - kPlaces + place, first + place, 0.0);
      }
      if (y > 0) {
        const int place = is_even ? kRight : kLeft;
        add_wall(first - kPlaces * across + place, first + place, 0.0);
      }
    }
  }
  return layout;
}

/// Neighbours are mirror images: an even number of rings repeats.
Vector2 period_of_rings(const RegularLattice& lattice) {
  const auto even = [](int cells) { return cells % 2 == 0 ? cells : 0; };
  return *lattice.side_mm * Vector2(even(*lattice.columns), even(*lattice.rows));
}

ClosedForms forms_of_rings(const RegularLattice& lattice, LoadingSpec::Direction) {
  const double side = *lattice.side_mm;
  const double thickness = *lattice.wall_thickness_mm;
  const double r = own_number(lattice, kRadius);
  const double axial = 1.0 / thickness;  // compliances over E
  const double bending = 12.0 * axial * axial * axial;
  constexpr double kSines = 0.25 * std::numbers::pi - 0.5;  // integral of sin^2 over an arc, from its middle
  constexpr double kCosines = 0.25 * std::numbers::pi + 0.5;
  const double turning = side * (r * r * bending + axial) + kSines * r * (r * r * bending + axial);
  const double constant = -2.0 * r * (side + r) / (4.0 * side + std::numbers::pi * r);  // m - r n of an arc
  const double at_ends = r + 2.0 * constant;                                            // moment of the ligaments
  const double of_arcs = r * r * kCosines + 4.0 * r * constant + std::numbers::pi * constant * constant;
  const double shearing = side * (at_ends * at_ends * bending + axial) + r * (of_arcs * bending + kCosines * axial);
  return {.density = thickness * (2.0 * side + 2.0 * std::numbers::pi * r) / (side * side),
          .modulus = 2.0 / (turning + shearing),
          .poissons_ratio = (shearing - turning) / (turning + shearing),
          .collapse_stress = thickness * thickness / (2.0 * r * side)};
}

}  // namespace

const LatticeKind& anti_tetrachiral_lattice() {
  static const LatticeKind kKind = {
      .name = "anti_tetrachiral",
      .plural = "anti-tetrachiral rings",
      .walls_per_cell = 6.0,
      .own_numbers = {{kRadius, [](const RegularLattice& its) { return 0.2 * its.side_mm.value_or(0.0); }, 0.49}},
      .check = check_rings,
      .lay_out = lay_out_rings,
      .period = period_of_rings,
      .closed_forms = forms_of_rings,
      .mesh =
          [](const SceneSpec& spec) {
            const auto elements = [&](int of_quarter) { return elements_for(of_quarter, *regular_lattice_of(spec)); };
            return DefaultMesh{elements(2), elements(4), elements(8), "anti-tetrachiral rings"};
          },
  };
  return kKind;
}

}  // namespace cellcrush
