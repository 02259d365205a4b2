#include "lattice/voronoi.h"

#include <algorithm>
#include <array>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "lattice/nuclei.h"

namespace cellcrush {
namespace {

using Diagram = boost::polygon::voronoi_diagram<double>;

/// Wider than the product of three distances of nuclei.
__extension__ using Wide = __int128;

/// The cells of nuclei and of copies of them around the period.
class VoronoiCells {
 public:
  explicit VoronoiCells(const Nuclei& nuclei) : count_(nuclei.places.size()) {
    constexpr std::int64_t kMarginInPitches = 8;  // no empty circle is as large as that
    const GridPlace& period = nuclei.period;
    const std::int64_t margin = kMarginInPitches * nuclei.pitch;
    sites_ = nuclei.places;
    for (const std::int64_t right : {-1, 0, 1}) {
      for (const std::int64_t up : {-1, 0, 1}) {
        if (right == 0 && up == 0) continue;
        for (const GridPlace& place : nuclei.places) {
          const GridPlace copy = {place.x + right * period.x, place.y + up * period.y};
          const bool is_near =
              copy.x >= -margin && copy.x <= period.x + margin && copy.y >= -margin && copy.y <= period.y + margin;
          if (is_near) sites_.push_back(copy);
        }
      }
    }
    std::vector<boost::polygon::point_data<int>> points;
    points.reserve(sites_.size());
    for (const GridPlace& site : sites_) points.emplace_back(static_cast<int>(site.x), static_cast<int>(site.y));
    boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram_);
    for (const Diagram::vertex_type& vertex : diagram_.vertices()) places_.push_back(place_of(vertex));
  }

  /// Calls visit(start, end) for each edge between two vertices, in units of the nuclei.
  template <class Visit>
  void visit_edges(const Visit& visit) const {
    for (const Diagram::edge_type& edge : diagram_.edges()) {
      if (edge.is_infinite() || edge.cell()->source_index() > edge.twin()->cell()->source_index()) continue;
      visit(place(*edge.vertex0()), place(*edge.vertex1()));
    }
  }

  /// The centroids of the cells of the nuclei, as offsets from these.
  [[nodiscard]] std::vector<Vector2> centroids() const {
    std::vector<Vector2> centroids(count_, Vector2::Zero());
    for (const Diagram::cell_type& cell : diagram_.cells()) {
      if (cell.source_index() >= count_) continue;
      const Vector2 nucleus = vector_of(sites_[cell.source_index()]);
      double area = 0.0;
      Vector2 moment = Vector2::Zero();
      const Diagram::edge_type* edge = first_edge_of(cell);
      const Diagram::edge_type* const first = edge;
      do {
        const Vector2 from = place(*edge->vertex0()) - nucleus;
        const Vector2 to = place(*edge->vertex1()) - nucleus;
        const double triangle = 0.5 * (from.x() * to.y() - from.y() * to.x());
        area += triangle;
        moment += triangle / 3.0 * (from + to);
        edge = edge->next();
      } while (edge != first);
      centroids[cell.source_index()] = moment / area;
    }
    return centroids;
  }

 private:
  static Vector2 vector_of(const GridPlace& place) {
    return {static_cast<double>(place.x), static_cast<double>(place.y)};
  }

  [[nodiscard]] const Vector2& place(const Diagram::vertex_type& vertex) const {
    return places_[static_cast<std::size_t>(&vertex - diagram_.vertices().data())];
  }

  /// The edge of a cell that starts at the lowest vertex: sums then do not depend on the order of the diagram's lists.
  [[nodiscard]] const Diagram::edge_type* first_edge_of(const Diagram::cell_type& cell) const {
    const Diagram::edge_type* first = cell.incident_edge();
    for (const Diagram::edge_type* edge = first->next(); edge != cell.incident_edge(); edge = edge->next()) {
      const Vector2& here = place(*edge->vertex0());
      const Vector2& best = place(*first->vertex0());
      if (std::tie(here.y(), here.x()) < std::tie(best.y(), best.x())) first = edge;
    }
    return first;
  }

  /// Centre of the circle through the three least of the nuclei that meet at a vertex.
  [[nodiscard]] Vector2 place_of(const Diagram::vertex_type& vertex) const {
    std::vector<GridPlace> around;
    const Diagram::edge_type* edge = vertex.incident_edge();
    do {
      around.push_back(sites_[edge->cell()->source_index()]);
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
    std::ranges::sort(around, {}, [](const GridPlace& site) { return std::tie(site.y, site.x); });
    const Wide bx = around[1].x - around[0].x;
    const Wide by = around[1].y - around[0].y;
    const Wide cx = around[2].x - around[0].x;
    const Wide cy = around[2].y - around[0].y;
    const Wide b = bx * bx + by * by;
    const Wide c = cx * cx + cy * cy;
    const auto twice_area = static_cast<double>(2 * (bx * cy - by * cx));
    return vector_of(around[0]) + Vector2(static_cast<double>(cy * b - by * c) / twice_area,
                                          static_cast<double>(bx * c - cx * b) / twice_area);
  }

  std::size_t count_;
  std::vector<GridPlace> sites_;  ///< the nuclei, then their copies
  Diagram diagram_;
  std::vector<Vector2> places_;  ///< of the vertices
};

void relax(int steps, Nuclei& nuclei) {
  for (int step = 0; step < steps; ++step) {
    const std::vector<Vector2> offsets = VoronoiCells(nuclei).centroids();
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const GridPlace& from = nuclei.places[i];
      nuclei.places[i] = nuclei.wrapped({from.x + std::llround(offsets[i].x()), from.y + std::llround(offsets[i].y())});
    }
  }
}

/// Walls that reach into the rectangle, and a little more. Joints are numbered row by row, walls by their joints.
Layout walls_around(const VoronoiCells& cells, const Nuclei& nuclei, const Vector2& envelope) {
  const Vector2 unit =
      envelope.cwiseQuotient(Vector2(static_cast<double>(nuclei.period.x), static_cast<double>(nuclei.period.y)));
  std::map<std::pair<double, double>, int> joints;  // by y and x
  std::vector<std::pair<Vector2, Vector2>> edges;
  cells.visit_edges([&](const Vector2& start, const Vector2& end) {
    const Vector2 from = start.cwiseProduct(unit);
    const Vector2 to = end.cwiseProduct(unit);
    if (from == to || from.cwiseMax(to).minCoeff() < 0.0 || (envelope - from.cwiseMin(to)).minCoeff() < 0.0) return;
    edges.emplace_back(from, to);
    for (const Vector2& place : {from, to}) joints.emplace(std::pair(place.y(), place.x()), 0);
  });
  Layout layout;
  for (auto& [place, number] : joints) {
    number = static_cast<int>(layout.joints.size());
    layout.joints.emplace_back(place.second, place.first);
  }
  for (const auto& [from, to] : edges) {
    const auto [start, end] = std::minmax({joints.at({from.y(), from.x()}), joints.at({to.y(), to.x()})});
    LayoutWall& wall = layout.walls.emplace_back();
    wall.start = start;
    wall.end = end;
  }
  std::ranges::sort(layout.walls, {}, [](const LayoutWall& wall) { return std::pair(wall.start, wall.end); });
  return layout;
}

/// The set and two copies of it, further on along an axis.
Nuclei thrice(const Nuclei& nuclei, int axis) {
  Nuclei out = nuclei;
  const GridPlace step = axis == 0 ? GridPlace{nuclei.period.x, 0} : GridPlace{0, nuclei.period.y};
  out.period = {nuclei.period.x + 2 * step.x, nuclei.period.y + 2 * step.y};
  for (const int copy : {1, 2}) {
    for (const GridPlace& place : nuclei.places) {
      out.places.push_back({place.x + copy * step.x, place.y + copy * step.y});
    }
  }
  return out;
}

/// Of walls that repeat thrice along an axis, keeps those of one period in the middle. It begins in the widest gap
/// between joints, so that round-off decides of no wall.
void keep_one_period(int axis, double period, Layout& layout) {
  std::vector<double> places;
  for (const Vector2& joint : layout.joints) {
    if (joint[axis] >= 0.5 * period && joint[axis] < 1.5 * period) places.push_back(joint[axis]);
  }
  std::ranges::sort(places);
  double begin = period;
  double widest = 0.0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if (places[i + 1] - places[i] <= widest) continue;
    widest = places[i + 1] - places[i];
    begin = 0.5 * (places[i] + places[i + 1]);
  }
  std::vector<char> is_kept;
  for (const LayoutWall& wall : layout.walls) {
    const double low = std::min(layout.joints[wall.start][axis], layout.joints[wall.end][axis]);
    is_kept.push_back(low >= begin && low < begin + period ? 1 : 0);
  }
  keep_walls(is_kept, layout);
  for (Vector2& joint : layout.joints) joint[axis] -= begin;
}

}  // namespace

Vector2 envelope_of(const VoronoiWalls& lattice) {
  return {std::numbers::sqrt3 * *lattice.side_mm * *lattice.columns, 1.5 * *lattice.side_mm * *lattice.rows};
}

double count_elements(const VoronoiWalls& lattice, int elements_per_wall) {
  return 3.0 * *lattice.columns * *lattice.rows * elements_per_wall;
}

VoronoiLayout lay_out_voronoi(const VoronoiWalls& lattice, std::optional<int> repeats_along) {
  Nuclei nuclei = place_nuclei(lattice);
  relax(lattice.relaxation_steps, nuclei);
  const Vector2 envelope = envelope_of(lattice);
  Vector2 cut = envelope;
  if (repeats_along) {
    nuclei = thrice(nuclei, *repeats_along);
    cut[*repeats_along] *= 3.0;
  }
  VoronoiLayout out;
  out.layout = walls_around(VoronoiCells(nuclei), nuclei, cut);
  const double edge_thickness = lattice.edge_walls ? 1.0 : 0.0;  // that of all walls, once it is known
  out.islands = cut_at(rectangle_between(Vector2::Zero(), cut), edge_thickness, out.layout);
  if (repeats_along) {
    keep_one_period(*repeats_along, envelope[*repeats_along], out.layout);
    out.islands = {};
  }
  double length = 0.0;
  for (const LayoutWall& wall : out.layout.walls) {
    length += out.layout.chord_of(wall);
  }
  out.thickness =
      lattice.relative_density ? *lattice.relative_density * envelope.prod() / length : *lattice.wall_thickness_mm;
  for (LayoutWall& wall : out.layout.walls) wall.thickness = out.thickness;
  return out;
}

}  // namespace cellcrush
