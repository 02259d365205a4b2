#pragma once

#include "cellcrush/contact_faces.h"
#include "cellcrush/scene.h"

namespace cellcrush {

/// Traces the faces of a scene for the search of contacts, and decides whether it may go by them; if it may not, all
/// but the premise is empty. If it may, cuts a large lattice into bands. REQUIRES: particles, walls, elements and
/// incidence.
///
/// Why a face is enough. The mid-lines of the walls divide the plane into faces, and while no wall crosses another this
/// division never changes, however crushed it is. Whatever goes from a ball to a segment that borders no face of the
/// ball's crosses a mid-line on its way; that wall is nearer, and it is the one the ball touches. So the balls and the
/// segments of each face are all there is to hold against each other.
///
/// What shares no face is left out without loss or nearly so:
///  - a ball above the round end of a segment that runs away from the ball's face: the segments beside it that end at
///    the same particle border the face, and give the same touch. The end of a wall that is thicker than these stands
///    out between them: it is a thick end, and searched with the face (contact/topology/face_loops.h);
///  - a ball that reaches a segment through the wall between them, pressed flat at a sharp joint. In crushes of blocks
///    of hexagons, squares and triangles these are up to 0.4 % of what overlaps, up to 0.17 of the wall deep; each lies
///    above a nearer segment of its polyline, so that none of them pushes (tests/core/crush/face_audit_test.cpp).
///
/// When it is not enough:
///  - walls have crossed: then the faces are no longer those of the drawing. The search finds that and goes over to
///    buckets (contact/search/face_search.h);
///  - parts that nothing joins, one in a face of the other, or walls that end in a face: `Premise` names them. They are
///    searched by buckets from the start.
/// Elements that cross before loading are refused as input where there is contact (contact/topology/initial_overlap.h);
/// here they show in Euler's formula.
void build_contact_faces(Scene& scene);

}  // namespace cellcrush
