#include "translate/preview_case.h"

#include <utility>
#include <vector>

#include "cellcrush/lattice_view.h"
#include "cellcrush/simulation.h"
#include "drawing/lattice_marks.h"
#include "translate/case_to_spec.h"
#include "translate/check_case.h"
#include "translate/loads_places.h"
#include "translate/results.h"

namespace cellcrush::translate {
namespace {

using drawing::DrawnPlace;

/// The elements as walls between particles.
drawing::Net net_of(const v1::Mesh& mesh) {
  drawing::Net net;
  for (int i = 0; i + 1 < mesh.position_mm_size(); i += 2) {
    net.joints.push_back({mesh.position_mm(i), mesh.position_mm(i + 1)});
  }
  for (int i = 0; i + 1 < mesh.element_nodes_size(); i += 2) {
    net.walls.emplace_back(mesh.element_nodes(i), mesh.element_nodes(i + 1));
  }
  return net;
}

/// The middles of the last elements, which do not deform.
std::vector<DrawnPlace> rigid_links_of(const drawing::Net& net, int count) {
  std::vector<DrawnPlace> places;
  for (std::size_t i = net.walls.size() - static_cast<std::size_t>(count); i < net.walls.size(); ++i) {
    const DrawnPlace& start = net.joints[net.walls[i].first];
    const DrawnPlace& end = net.joints[net.walls[i].second];
    places.push_back({0.5 * (start.x + end.x), 0.5 * (start.y + end.y)});
  }
  return places;
}

DrawnPlace to_place(const Vector2& place) { return {place.x(), place.y()}; }

void mark(const v1::Lattice& lattice, const LatticeView& view, v1::PreviewCaseResponse& out) {
  auto& marks = *out.mutable_marks();
  const drawing::Net net = net_of(out.mesh());
  std::vector<DrawnPlace> crossings;
  for (const Vector2& place : view.crossings) crossings.push_back(to_place(place));
  drawing::add_marks(v1::LatticeMarks::CROSSING, crossings, marks);
  std::vector<DrawnPlace> overlaps;
  for (const int particle : out.mesh().overlap_particle()) overlaps.push_back(net.joints[particle]);
  drawing::add_marks(v1::LatticeMarks::OVERLAP, overlaps, marks);
  // The ends of a frame's beams are held, loaded or free as it says.
  if (!lattice.has_frame()) {
    drawing::add_marks(v1::LatticeMarks::LOOSE_END, drawing::find_loose_ends(net), marks);
    drawing::add_marks(v1::LatticeMarks::ISLAND, drawing::find_islands(net), marks);
  }
  // The rigid elements of hexagons are stiff cells.
  if (!lattice.has_hexagon()) {
    drawing::add_marks(v1::LatticeMarks::RIGID_LINK, rigid_links_of(net, out.mesh().rigid_element_count()), marks);
  }
  if (view.slowest) drawing::add_marks(v1::LatticeMarks::SLOWEST_WALL, {to_place(*view.slowest)}, marks);
}

}  // namespace

v1::PreviewCaseResponse preview_case(const v1::Case& submitted, const std::function<void()>& between_stages) {
  v1::PreviewCaseResponse out;
  *out.mutable_problems() = find_long_lists(submitted);
  if (!out.problems().empty()) return out;
  auto reading = to_spec(submitted);
  between_stages();
  LatticeView view = view_lattice(reading.spec, between_stages);
  name_as_given(submitted, view.problems);
  for (const Problems* problems : {&reading.problems, &view.problems}) {
    for (const auto& problem : *problems) *out.add_problems() = to_proto(problem);
  }
  cut_problems(*out.mutable_problems());
  if (!view.scene || !reading.problems.empty()) return out;
  *out.mutable_mesh() = to_proto(mesh_of(*view.scene));
  if (out.mesh().ByteSizeLong() > kLargestPreview && reading.spec.elements_per_wall != 1) {
    reading.spec.elements_per_wall = 1;
    LatticeView coarse = view_lattice(reading.spec, between_stages);
    if (coarse.scene) {
      view = std::move(coarse);
      *out.mutable_mesh() = to_proto(mesh_of(*view.scene));
    }
  }
  mark(submitted.lattice(), view, out);
  return out;
}

}  // namespace cellcrush::translate
