#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cellcrush/contact_faces.h"
#include "cellcrush/scene.h"

namespace cellcrush {

/// The loop round a face of a planar drawing, with the face on its left: round inner faces counter-clockwise, round the
/// outer border of a part clockwise.
struct FaceLoop {
  std::vector<int> particle;  ///< the corners, then the far ends of thick ends
  std::vector<int> element;   ///< from each corner to the next one, then thick ends
  std::size_t corners = 0;    ///< number of corners
  double area = 0.0;          ///< mm^2; negative for an outer border, 0 round a tree

  [[nodiscard]] bool is_outer() const { return area < 0.0; }
};

/// The loops round all faces. Every element is in two loops, once in each direction. A walk along half-edges turns
/// clockwise into the next element at each particle, so that the face stays on its left. REQUIRES: elements of nonzero
/// length.
std::vector<FaceLoop> trace_loops(std::span<const Vector2> position, std::span<const Element> elements);

/// Appends to a loop its thick ends: elements that end at a corner of the loop without bordering its face, and are
/// thicker than both walls of the face there. Only their round ends stand out into the face. `particle` of a thick end
/// is the end that is not the corner. REQUIRES: incidence; a loop as traced that passes no particle twice.
void append_thick_ends(const Scene& scene, FaceLoop& loop);

/// Area within a loop of particles, mm^2; negative where it runs clockwise.
double area_within(std::span<const int> loop, std::span<const Vector2> position);

/// Traces the faces of a scene for the search of contacts, and decides whether it may go by them; if it may not, all
/// but the premise is empty. If it may, cuts a large lattice into bands. REQUIRES: particles, walls, elements and
/// incidence.
///
/// core/contact.md explains why a face is enough, and which pairs it leaves out. It is not enough where walls have
/// crossed, which the search finds (contact/contact_search.h), where nothing joins two parts, or where a wall ends in a
/// face: `Premise` names these. Elements that cross before loading are refused where there is contact
/// (contact/topology/initial_overlap.h); here they show in Euler's formula.
void build_contact_faces(Scene& scene);

}  // namespace cellcrush
