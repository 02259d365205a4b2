#include "measure/crush_mode.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "contact/repeated_mesh.h"
#include "contact/topology/face_loops.h"
#include "push/crush.h"

namespace cellcrush {
namespace {

/// A band: cells whose distance along the crush from a mid-line is at most half of a width.
struct Band {
  CrushMode kind = CrushMode::none;
  double agreement = 0.0;
  std::vector<bool> inside;  ///< C
};

/// Mid-lines that are tried: all of these combinations, at positions along the crush that are half a cell apart.
struct MidLines {
  std::vector<double> slopes;  ///< distance along the crush over distance across it
  std::vector<double> points;  ///< where the arms meet, across the lattice over its width
  std::vector<double> signs;   ///< of the slope
};

/// Searches the mid-lines of one kind for the band that agrees best with the collapsed cells. A band has one, two or
/// four arms. In each of them at least a fraction kLeastOfArm of its cells has collapsed. They are at least a fraction
/// kLeastOfBand of an even share of the collapsed cells of the band.
class BandSearch {
 public:
  BandSearch(const CollapseField& field, CrushMode kind, int arms, double to_beat) : field_(field), arms_(arms) {
    best_.kind = kind;
    best_.agreement = to_beat;
    bins_ = static_cast<std::size_t>(field.length * bins_per_mm()) + 1;
    hit_.assign(field.collapsed.begin(), field.collapsed.end());
    collapsed_ = static_cast<double>(std::count(hit_.begin(), hit_.end(), 1));
    bin_of_.resize(field.along.size());
  }

  /// Tries every width round all of the lines. At s along the crush and t across it from the point of a line,
  /// distance(s, t, slope) gives the signed distance from the line along the crush, mm, and arm(s, t) the number of the
  /// arm to which a cell would belong.
  template <class Distance, class Arm>
  void try_lines(const MidLines& lines, const Distance& distance, const Arm& arm) {
    for (const double slope : lines.slopes) {
      for (const double point : lines.points) {
        for (const double sign : lines.signs) {
          for (double place = 0.0; place <= field_.length; place += 0.5 * field_.pitch) {
            try_line(place, point * field_.width, sign * slope, distance, arm);
          }
        }
      }
    }
  }

  [[nodiscard]] const Band& best() const { return best_; }

 private:
  /// Number of cells of an arm, and of those that have collapsed.
  struct Count {
    int all = 0;
    int hit = 0;
  };

  template <class Distance, class Arm>
  void try_line(double along, double across, double slope, const Distance& distance, const Arm& arm) {
    counts_.assign((bins_ + 1) * arms_, {});
    // Cells beyond the widest band share one more bin, the last one.
    for (std::size_t cell = 0; cell < bin_of_.size(); ++cell) {
      const double off = distance(field_.along[cell] - along, field_.across[cell] - across, slope);
      bin_of_[cell] = static_cast<int>(std::min(std::abs(off) * bins_per_mm(), static_cast<double>(bins_)));
    }
    for (std::size_t cell = 0; cell < bin_of_.size(); ++cell) {
      const int of = arm(field_.along[cell] - along, field_.across[cell] - across);
      Count& count = counts_[static_cast<std::size_t>(bin_of_[cell]) * arms_ + of];
      ++count.all;
      count.hit += hit_[cell];
    }
    if (const auto width = find_width()) {
      best_.inside.resize(bin_of_.size());
      std::transform(bin_of_.begin(), bin_of_.end(), best_.inside.begin(), [&](int bin) { return bin <= *width; });
    }
  }

  [[nodiscard]] double bins_per_mm() const { return 2.0 / field_.pitch; }

  /// The last bin of the width that agrees best, if it is better than the best so far.
  std::optional<int> find_width() {
    constexpr double kLeastOfArm = 0.4;
    constexpr double kLeastOfBand = 0.4;
    std::optional<int> width;
    std::array<Count, 4> arm{};
    Count band;
    for (std::size_t bin = 0; bin < bins_; ++bin) {
      for (int i = 0; i < arms_; ++i) {
        const Count& count = counts_[bin * arms_ + i];
        arm[i].all += count.all;
        arm[i].hit += count.hit;
        band.all += count.all;
        band.hit += count.hit;
      }
      const double agreement = 2.0 * band.hit / (band.all + collapsed_);
      const auto is_there = [&](const Count& part) {
        return part.hit >= kLeastOfArm * part.all && part.hit >= kLeastOfBand * band.hit / arms_;
      };
      if (agreement > best_.agreement && std::all_of(arm.begin(), arm.begin() + arms_, is_there)) {
        best_.agreement = agreement;
        width = static_cast<int>(bin);
      }
    }
    return width;
  }

  const CollapseField& field_;
  int arms_;
  Band best_;
  std::size_t bins_ = 0;       // each half a cell wide
  std::vector<Count> counts_;  // by bin of distance and arm
  std::vector<int> bin_of_;    // C, for the mid-line that is tried
  std::vector<int> hit_;       // C, 1: has collapsed
  double collapsed_ = 0.0;
};

/// Slopes that are tried: those that can be told from 0 in a lattice of this width.
std::vector<double> slopes_of(const CollapseField& field) {
  constexpr double kLeastRun = 3.0;  // cells along the crush over half of the width
  std::vector<double> slopes;
  for (const double degrees : {15.0, 25.0, 35.0, 45.0, 55.0, 65.0}) {
    const double slope = std::tan(degrees * std::numbers::pi / 180.0);
    if (slope * 0.5 * field.width >= kLeastRun * field.pitch) {
      slopes.push_back(slope);
    }
  }
  return slopes;
}

/// The band of any kind that agrees best; a later kind must be clearly better than those before it.
Band find_band(const CollapseField& field) {
  Band best;
  const auto consider = [&](CrushMode kind, int arms, const MidLines& lines, const auto& distance, const auto& arm) {
    const double to_beat = best.agreement + (best.inside.empty() ? 0.0 : kClearlyBetter);
    if (to_beat >= 1.0) {
      return;
    }
    BandSearch search(field, kind, arms, to_beat);
    search.try_lines(lines, distance, arm);
    if (!search.best().inside.empty()) {
      best = search.best();
    }
  };
  const std::vector<double> slopes = slopes_of(field);
  const std::vector<double> inside = {0.3, 0.4, 0.5, 0.6, 0.7};
  const auto straight = [](double s, double, double) { return s; };
  const auto pointed = [](double s, double t, double slope) { return s - slope * std::abs(t); };
  const auto crossing = [](double s, double t, double slope) { return std::abs(s) - slope * std::abs(t); };
  const auto bowed = [&](double s, double t, double slope) { return s - 2.0 * slope / field.width * t * t; };
  const auto whole = [](double, double) { return 0; };
  const auto by_s = [](double s, double) { return s < 0.0 ? 0 : 1; };
  const auto by_t = [](double, double t) { return t < 0.0 ? 0 : 1; };
  const auto by_both = [&](double s, double t) { return by_s(s, t) + 2 * by_t(s, t); };
  consider(CrushMode::i, 1, {{0.0}, {0.0}, {1.0}}, straight, whole);
  consider(CrushMode::v, 2, {slopes, inside, {1.0, -1.0}}, pointed, by_t);
  // Bands that cross on a side are a V whose point is there.
  consider(CrushMode::v, 2, {slopes, {0.0, 1.0}, {1.0}}, crossing, by_s);
  consider(CrushMode::x, 4, {slopes, inside, {1.0}}, crossing, by_both);
  consider(CrushMode::c, 2, {slopes, {0.4, 0.5, 0.6}, {1.0, -1.0}}, bowed, by_t);
  return best;
}

double count(const std::vector<bool>& cells) {
  return static_cast<double>(std::count(cells.begin(), cells.end(), true));
}

Vector2 mean_of(std::span<const int> loop, std::span<const Vector2> position) {
  Vector2 sum = Vector2::Zero();
  for (const int particle : loop) {
    sum += position[particle];
  }
  return sum / static_cast<double>(loop.size());
}

/// The faces whose centres lie within a period from the low side on.
Faces of_one_period(const Scene& scene, const Faces& all) {
  const int axis = scene.period.axis;
  constexpr double kRounded = 1e-6;  // of the period; centres can lie on the side
  const auto place_of = [axis](const Vector2& place) { return place[axis]; };
  const double begin = place_of(std::ranges::min(scene.position, {}, place_of)) - kRounded * scene.period.length;
  Faces faces;
  faces.offset.push_back(0);
  for (std::size_t face = 0; face < all.count(); ++face) {
    const double place = all.centre[face][axis];
    if (place < begin || place >= begin + scene.period.length) continue;
    std::ranges::copy(all.particles_of(face), std::back_inserter(faces.particles));
    std::ranges::copy(all.elements_of(face), std::back_inserter(faces.elements));
    faces.offset.push_back(static_cast<int>(faces.particles.size()));
    faces.area.push_back(all.area[face]);
    faces.centre.push_back(all.centre[face]);
  }
  return faces;
}

}  // namespace

double collapsed_fraction_of(const CollapseField& field) {
  return field.collapsed.empty() ? 0.0 : count(field.collapsed) / static_cast<double>(field.collapsed.size());
}

CrushMode find_crush_mode(const CollapseField& field) {
  constexpr int kMostBands = 3;
  constexpr double kWorthAnother = 0.25;  // fraction of the collapsed cells
  const double collapsed = count(field.collapsed);
  CollapseField rest = field;
  CrushMode kind = CrushMode::none;
  double inside = 0.0;
  double hit = 0.0;
  for (int bands = 0; bands < kMostBands && collapsed > 0.0; ++bands) {
    const Band band = find_band(rest);
    if (band.inside.empty() || (band.agreement < kLeastAgreement && bands > 0)) {
      break;
    }
    kind = kind == CrushMode::none || kind == band.kind ? band.kind : CrushMode::mixed;
    inside += count(band.inside);
    for (std::size_t cell = 0; cell < band.inside.size(); ++cell) {
      hit += band.inside[cell] && rest.collapsed[cell] ? 1.0 : 0.0;
      rest.collapsed[cell] = rest.collapsed[cell] && !band.inside[cell];
    }
    if (count(rest.collapsed) < kWorthAnother * collapsed) {
      break;
    }
  }
  return collapsed == 0.0 || 2.0 * hit / (inside + collapsed) >= kLeastAgreement ? kind : CrushMode::mixed;
}

Faces trace_faces(std::span<const Vector2> position, std::span<const Element> elements) {
  Faces faces;
  faces.offset.push_back(0);
  for (const FaceLoop& loop : trace_loops(position, elements)) {
    if (loop.area > 0.0) {
      faces.particles.insert(faces.particles.end(), loop.particle.begin(), loop.particle.end());
      faces.elements.insert(faces.elements.end(), loop.element.begin(), loop.element.end());
      faces.offset.push_back(static_cast<int>(faces.particles.size()));
      faces.area.push_back(loop.area);
      faces.centre.push_back(mean_of(loop.particle, position));
    }
  }
  return faces;
}

std::vector<double> area_ratios(const Faces& faces, std::span<const Vector2> position) {
  std::vector<double> ratios;
  ratios.reserve(faces.count());
  for (std::size_t face = 0; face < faces.count(); ++face) {
    ratios.push_back(area_within(faces.particles_of(face), position) / faces.area[face]);
  }
  return ratios;
}

Cells find_cells(const Scene& scene) {
  Cells cells;
  const Scene& mesh = scene.repeated != nullptr ? *scene.repeated : scene;
  cells.faces = trace_faces(mesh.position, mesh.elements);
  if (scene.repeated != nullptr) cells.faces = of_one_period(scene, cells.faces);
  const int axis = crush_axis_of(scene);
  Vector2 low = scene.position.front();
  Vector2 high = low;
  for (const Vector2& position : scene.position) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  const auto along = [&](int particle) { return mesh.position[particle][axis]; };
  double extents = 0.0;
  for (std::size_t face = 0; face < cells.faces.count(); ++face) {
    const auto [begin, end] = std::ranges::minmax_element(cells.faces.particles_of(face), {}, along);
    extents += along(*end) - along(*begin);
    const Vector2 centre = cells.faces.centre[face] - low;
    cells.field.along.push_back(centre[axis]);
    cells.field.across.push_back(centre[1 - axis]);
  }
  cells.field.collapsed.assign(cells.faces.count(), false);
  cells.field.length = (high - low)[axis];
  cells.field.width = (high - low)[1 - axis];
  cells.field.pitch = cells.faces.count() > 0 ? extents / static_cast<double>(cells.faces.count()) : 0.0;
  return cells;
}

std::span<const Vector2> places_of_cells(const Scene& scene, const State& state, std::vector<Vector2>& room) {
  if (scene.repeated == nullptr) return state.position;
  room = repeated_positions(scene, state);
  return room;
}

CollapseField find_collapse(const Cells& cells, std::span<const Vector2> position) {
  CollapseField field = cells.field;
  const std::vector<double> ratio = area_ratios(cells.faces, position);
  std::transform(ratio.begin(), ratio.end(), field.collapsed.begin(), [](double of) { return of <= kCollapsedArea; });
  return field;
}

}  // namespace cellcrush
