#pragma once

#include "cellcrush/contact_faces.h"
#include "cellcrush/scene.h"

namespace cellcrush {

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
