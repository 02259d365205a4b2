#include "measure/warnings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "contact/thickening.h"
#include "contact/touch/force_laws.h"
#include "measure/inertia.h"
#include "scene/check_spec.h"
#include "scene/solid_area.h"

namespace cellcrush {
namespace {

constexpr const char* kCompareShorterStep =
    "Use a shorter numerics.time_step_s, or 0 for an automatic step, and check whether the stresses change.";

/// A time or a coordinate in six digits.
std::string in_six_digits(double value) {
  std::array<char, 32> buffer{};
  char* const begin = buffer.data();
  return {begin, std::to_chars(begin, begin + buffer.size(), value, std::chars_format::general, 6).ptr};
}

/// Overlap of the touching pair `t`, over the thickness of the thinner wall.
double depth_of(const Scene& scene, const State& state, const TouchMemory& touching, std::size_t t) {
  const int ball = touching.ball[t];
  const int segment = touching.segment[t];
  const Element& element = scene.elements[segment];
  const double length = state.length[segment];
  const Vector2& axis = state.axis[segment];
  const Projection foot = project(state.position[ball], state.position[element.start], axis, length);
  const bool inside = foot.along > 0.0 && foot.along < length;
  const double distance = inside ? touching.side[t] * cross(axis, foot.offset) : foot.offset.norm();
  return (reach_at(scene, state, ball, segment, foot.along / length) - distance) /
         std::min(2.0 * scene.radius[ball], element.thickness);
}

/// l / l_0 up to which a wall stretches evenly: until it yields, and then as its law says.
double even_stretch(const LawFacts& law, const Material& material) {
  const double elastic = 1.0 + material.yield_stress / material.youngs_modulus;
  return elastic * std::exp(law.even_strain(material.yield_stress, material.law));
}

/// Calls visit(wall, elongation) for all walls: by how much their elements are longer than they can be stretched
/// evenly, over the thickness.
template <class Visit>
void visit_elongations(const Scene& scene, const State& state, const Visit& visit) {
  const Walls& walls = scene.walls;
  std::vector<double> stretch;
  stretch.reserve(scene.materials.size());
  for (const Material& material : scene.materials) stretch.push_back(even_stretch(Laws::kFacts[scene.law], material));
  for (const WallBlock& block : walls.blocks) {
    for (int w = 0; w < block.walls; ++w) {
      const int wall = block.first_wall + w;
      const double even = stretch[walls.material[wall]] * walls.undeformed_length[wall];
      double elongation = 0.0;
      for (int j = 0; j < block.elements; ++j) {
        elongation += std::max(0.0, state.length[block.first_element + j * block.walls + w] - even);
      }
      visit(wall, elongation / walls.thickness[wall]);
    }
  }
}

/// Adds the warning about a quantity over the turnover if it exceeds kEnergyDrift, with the time at which it first does
/// and its maximum.
template <class Quantity>
void add_drift(std::span<const Sample> samples, Warning::Kind kind, const std::string& what, Quantity&& quantity,
               std::vector<Warning>& warnings) {
  double most = 0.0;
  for (const Sample& sample : samples) {
    most = std::max(most, turnover_of(sample));
  }
  const Sample* first = nullptr;
  double greatest = 0.0;
  for (const Sample& sample : samples) {
    const double turnover = turnover_of(sample);
    if (turnover <= 0.01 * most) {
      continue;
    }
    const double share = quantity(sample) / turnover;
    if (share > kEnergyDrift && first == nullptr) {
      first = &sample;
    }
    greatest = std::max(greatest, share);
  }
  if (first != nullptr) {
    warnings.push_back({kind, first->step, first->strain,
                        what + " more than 1 % of the work done, from " + moment_of(first->step, first->time) +
                            " on; the maximum is " + percent_of(greatest) + ".",
                        kCompareShorterStep});
  }
}

}  // namespace

Warning warn_of_depth(const Scene& scene, const State& state, double strain) {
  return {Warning::Kind::deep_penetration, state.step, strain,
          "Walls had overlapped by " + percent_of(state.contact_totals.deepest_penetration) +
              " of the thinner wall's thickness by " + moment_of(state.step, state.time) + deepest_place(scene, state) +
              ".",
          std::string(kCompareShorterStep) + " A larger contact.stiffness_factor reduces the overlap of slow walls."};
}

Warning warn_of_borders(const State& state, double strain) {
  return {Warning::Kind::borders_near, state.step, strain,
          "Distant parts of the lattice's border had come close to each other by " + moment_of(state.step, state.time) +
              "; from then on, contacts are searched in space, which finds the same contacts but is slower.",
          "No action is needed: the result is valid. If numerics.time_step_s was given, 0 (an automatic step) may "
          "avoid the slower search."};
}

Warning warn_of_density(const State& state, const Sample& sample) {
  return {Warning::Kind::denser_than_solid, state.step, sample.strain,
          words_of(sample.densest_layer) + ", at " + moment_of(state.step, state.time) +
              ". Metal cannot be denser than solid: walls overlap there.",
          "Take the stresses of solid metal from here on as a lower bound, or give a smaller loading.end_strain."};
}

Warning warn_of_closing(const Scene& scene, const State& state, double strain) {
  constexpr double kDense = 0.5;  // solid fraction before loading
  const std::optional<double> closed = closing_strain_of(scene);
  const std::string where =
      closed ? "strain " + to_text(std::round(1e3 * *closed) / 1e3) : moment_of(state.step, state.time);
  return {Warning::Kind::closed, state.step, strain,
          "From " + where + " on " + (closed ? "the lattice" : "the frame") + " is closed: walls fill " +
              percent_of(kClosed) + " of the volume between the " + (closed ? "plates" : "rigid walls") +
              ". From there on stress and work depend on the mesh and on the stiffness of contacts, not on the metal." +
              (closed && solid_fraction_at(scene, 0.0) > kDense
                   ? " Of so dense a lattice the bound is cautious: meshes agree for a while past it."
                   : ""),
          closed ? "Take results up to that strain; plateau, energy and densification are those before it. Leave out "
                   "loading.end_strain to end the run there."
                 : "Take results up to that time, or give it as loading.end_time_s."};
}

std::optional<Warning> warn_of_necks(const Scene& scene, const State& state, double strain) {
  std::size_t count = 0;
  int most = 0;
  double most_elongation = 0.0;
  visit_elongations(scene, state, [&](int wall, double elongation) {
    count += elongation > 1.0 ? 1 : 0;
    if (elongation > most_elongation) {
      most = wall;
      most_elongation = elongation;
    }
  });
  const std::size_t walls = scene.walls.start.size();
  if (static_cast<double>(count) <= kNeckedWalls * static_cast<double>(walls)) {
    return std::nullopt;
  }
  return Warning{Warning::Kind::walls_neck, state.step, strain,
                 "Of " + std::to_string(walls) + " walls, " + std::to_string(count) +
                     " had passed their even stretch by a thickness at " + moment_of(state.step, state.time) +
                     ". Real ones would have necked and torn; these keep their area and their yield force. The wall "
                     "stretched most starts at " +
                     place_of(scene, scene.walls.start[most]) + ", by " + percent_of(most_elongation) +
                     " of its thickness.",
                 "Fracture is not modelled: take the stresses from here on as an upper bound. If the material hardens, "
                 "give material.hardening_modulus_mpa."};
}

double turnover_of(const Sample& sample) {
  return std::max(std::abs(sample.energies.external), sample.energies.kinetic + sample.energies.initial);
}

std::vector<Warning> collect_warnings(const Scene& scene, std::span<const Sample> samples) {
  std::vector<Warning> warnings;
  for (const Sample& sample : samples) {
    warnings.insert(warnings.end(), sample.warnings.begin(), sample.warnings.end());
  }
  add_drift(
      samples, Warning::Kind::energy_drift, "The energy balance has an error of",
      [](const Sample& sample) { return std::abs(sample.energies.residual); }, warnings);
  add_drift(
      samples, Warning::Kind::contact_energy, "Contacts have created energy of",
      [](const Sample& sample) { return -sample.energies.contact; }, warnings);
  if (const std::optional<Warning> inertia = warn_of_inertia(scene, samples)) {
    warnings.push_back(*inertia);
  }
  std::stable_sort(warnings.begin(), warnings.end(),
                   [](const Warning& a, const Warning& b) { return a.step < b.step; });
  return warnings;
}

std::string deepest_place(const Scene& scene, const State& state) {
  if (scene.repeated != nullptr) return "";  // the lists have the numbers of its copies
  int ball = -1;
  int segment = -1;
  double most = 0.0;
  for (const ContactLists& lists : state.contacts) {
    for (std::size_t t = 0; t < lists.touching.count(); ++t) {
      if (const double depth = depth_of(scene, state, lists.touching, t); ball < 0 || depth > most) {
        ball = lists.touching.ball[t];
        segment = lists.touching.segment[t];
        most = depth;
      }
    }
  }
  return ball < 0 ? ""
                  : "; deepest now at " + place_of(scene, ball) + ", in the wall of element " + std::to_string(segment);
}

std::string words_of(const DensestLayer& layer) {
  return "Walls fill the layer that was " + to_text(std::round(10.0 * layer.place) / 10.0) +
         " mm from the impact end before loading by " + percent_of(layer.solid_fraction) + " of its volume";
}

std::string moment_of(std::int64_t step, double time) {
  return "step " + std::to_string(step) + ", t = " + in_six_digits(time) + " s";
}

std::string place_of(const Scene& scene, std::size_t particle) {
  return "particle " + std::to_string(particle) + ", at (" + in_six_digits(scene.position[particle].x()) + ", " +
         in_six_digits(scene.position[particle].y()) + ") mm before loading";
}

std::string percent_of(double share) { return to_text(std::round(1000.0 * share) / 10.0) + " %"; }

}  // namespace cellcrush
