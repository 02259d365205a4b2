#include "core/scene/unit_cell.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace cellcrush {
namespace {

using Key = std::pair<long, long>;

Key key_of(const Vector2& place) { return {std::lround(place.x() * 1e6), std::lround(place.y() * 1e6)}; }

/// Points by their places, up to rounding.
class Places {
 public:
  int find_or_add(const Vector2& place) {
    if (const int found = find(place); found >= 0) return found;
    return number_[key_of(place)] = static_cast<int>(number_.size());
  }

  [[nodiscard]] int find(const Vector2& place) const {
    const Key middle = key_of(place);
    for (const long x : {-1, 0, 1}) {
      for (const long y : {-1, 0, 1}) {
        const auto found = number_.find({middle.first + x, middle.second + y});
        if (found != number_.end()) return found->second;
      }
    }
    return -1;
  }

  [[nodiscard]] int count() const { return static_cast<int>(number_.size()); }

 private:
  std::map<Key, int> number_;
};

/// The two shortest translations that bring the middle half of a scene upon itself, as columns.
Eigen::Matrix2d translations_of(const Scene& scene) {
  Vector2 low = scene.position.front();
  Vector2 high = low;
  Places places;
  for (const Vector2& place : scene.position) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
    places.find_or_add(place);
  }
  const Vector2 centre = 0.5 * (low + high);
  Places middles;
  std::vector<Vector2> middle_of_element;
  std::vector<Vector2> along_middle;  // by the numbers of the middles
  for (const Element& element : scene.elements) {
    middle_of_element.push_back(0.5 * (scene.position[element.start] + scene.position[element.end]));
    middles.find_or_add(middle_of_element.back());
    along_middle.push_back(scene.position[element.end] - scene.position[element.start]);
  }
  const auto is_inner = [&](const Vector2& place) {
    return ((place - centre).cwiseAbs().array() < 0.25 * (high - low).array()).all();
  };
  const auto is_translation = [&](const Vector2& by) {
    for (std::size_t i = 0; i < middle_of_element.size(); ++i) {
      if (!is_inner(middle_of_element[i])) continue;
      const int found = middles.find(middle_of_element[i] + by);
      if (found < 0) return false;
      const double dot = along_middle[i].dot(along_middle[found]);
      if (std::abs(std::abs(dot) - along_middle[i].squaredNorm()) > 1e-6) return false;
    }
    return true;
  };
  const Vector2& from = *std::ranges::min_element(scene.position, {},
                                                  [&](const Vector2& place) { return (place - centre).squaredNorm(); });
  std::vector<Vector2> candidates;
  for (const Vector2& place : scene.position) {
    const Vector2 by = place - from;
    if (by.norm() > 1e-6 && is_inner(centre + by)) candidates.push_back(by);
  }
  std::ranges::sort(candidates, {}, [](const Vector2& by) { return by.squaredNorm(); });
  Eigen::Matrix2d found = Eigen::Matrix2d::Zero();
  for (const Vector2& by : candidates) {
    const double area = found(0, 0) * by.y() - found(1, 0) * by.x();
    if (found.col(0).norm() > 0.0 && std::abs(area) < 1e-6 * by.squaredNorm()) continue;
    if (!is_translation(by)) continue;
    if (found.col(0).norm() > 0.0) {
      found.col(1) = by;
      return found;
    }
    found.col(0) = by;
  }
  return Eigen::Matrix2d::Zero();
}

}  // namespace

UnitCell find_unit_cell(const Scene& scene) {
  UnitCell cell;
  const Eigen::Matrix2d translations = translations_of(scene);
  cell.area = std::abs(translations.determinant());
  if (cell.area == 0.0) return cell;
  const Eigen::Matrix2d inverse = translations.inverse();
  Vector2 centre = Vector2::Zero();
  for (const Vector2& place : scene.position) centre += place / static_cast<double>(scene.particle_count());
  const Vector2 origin = inverse * centre + Vector2(0.1234567, 0.2345678);  // no point lies on the edge of the cell
  const auto cell_of = [&](const Vector2& place) -> Vector2 { return (inverse * place - origin).array().floor(); };
  Places nodes;
  for (const Element& element : scene.elements) {
    const Vector2 start = scene.position[element.start];
    const Vector2 end = scene.position[element.end];
    if (!cell_of(0.5 * (start + end)).isZero()) continue;
    const int from = nodes.find_or_add(start - translations * cell_of(start));
    const int to = nodes.find_or_add(end - translations * cell_of(end));
    cell.beams.push_back({from, to, end - start, element.thickness});
  }
  cell.nodes = nodes.count();
  return cell;
}

}  // namespace cellcrush
