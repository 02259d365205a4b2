#pragma once

#include <vector>

namespace cellcrush {

/// Faces of a band: those with particles of the band but of no earlier band. The last one is the part of the outer face
/// at the band and its neighbours. With only one band, all faces. Round a face its corners are stored first, then its
/// thick ends: elements whose round ends stand out into it (contact/topology/face_loops.h). F faces, S corners and
/// thick ends, G groups.
struct FacesOfBand {
  std::vector<int> number;      ///< F, among all faces
  std::vector<int> offset;      ///< F + 1, into corners and thick ends
  std::vector<int> corner_end;  ///< F, index of the first thick end of a face
  /// S, corners with the face on the left: cells counter-clockwise, the outer face clockwise. Of a thick end, the end
  /// that is not a corner.
  std::vector<int> particle;
  std::vector<int> element;  ///< S, from each corner to the next one; or a thick end
  /// Whether the last face, the outer one, has all its corners; otherwise it has only those of the band and its
  /// neighbours.
  bool is_outer_whole = true;

  // Groups of adjacent faces that are checked together; the outer face is a group of its own, the last one.
  std::vector<int> group_offset;   ///< G + 1, into faces
  std::vector<int> member_offset;  ///< G + 1, into members
  std::vector<int> member;         ///< particles at the faces of a group, each listed once

  [[nodiscard]] int count() const { return static_cast<int>(offset.size()) - 1; }
  [[nodiscard]] int group_count() const { return static_cast<int>(group_offset.size()) - 1; }
  [[nodiscard]] int corner_count(int face) const { return corner_end[face] - offset[face]; }
};

/// An element and the face into which its round end stands out.
struct ThickEnd {
  int element = 0;
  int face = 0;  ///< among all faces
};

/// A particle on the outer border of a lattice that is cut into bands.
struct BorderParticle {
  int particle = 0;
  int band = 0;       ///< the band that owns the particle
  int last_band = 0;  ///< the last band that has elements at the particle
};

/// The faces into which the elements divide the plane, for the contact search (E8c, contact/search/pair_search.h): the
/// cells and the outer border. E elements. Built by build_contact_faces; empty where contacts are searched by buckets.
struct ContactFaces {
  /// Whether a search by faces finds every contact, and if not, why.
  enum class Premise {
    holds,
    no_contact,     ///< no contact between walls: nothing to search
    not_asked,      ///< the case requests buckets
    sides_repeat,   ///< faces across the sides are not traced
    walls_break,    ///< faces merge where walls break
    several_parts,  ///< separate parts can lie in faces that they do not border
    not_closed,  ///< an element has the same face on both sides, or a face touches itself at a particle: trees, bridges
    not_planar   ///< elements cross without a common particle
  };
  Premise premise = Premise::no_contact;

  std::vector<int> side;               ///< 2 E, the faces on the left and on the right of each element
  std::vector<ThickEnd> thick_ends;    ///< by element; empty if all walls are equally thick
  std::vector<FacesOfBand> bands;      ///< one for each of Scene::bands
  std::vector<BorderParticle> border;  ///< band by band; empty if there is only one band

  [[nodiscard]] bool are_enough() const { return premise == Premise::holds; }
};

}  // namespace cellcrush
