#pragma once

#include <vector>

namespace cellcrush {

/// The faces with particles of a band and of none before, and what the band and its neighbours have of the outer one
/// (all faces, where there is but one band). Round a face stand its corners; then its thick ends, the elements whose
/// round ends stand out into it (scene/thick_ends.h). F faces, S corners and thick ends, G groups.
struct FacesOfBand {
  std::vector<int> number;      ///< F, among all faces
  std::vector<int> offset;      ///< F + 1, into corners and thick ends
  std::vector<int> corner_end;  ///< F, where the thick ends of a face begin
  std::vector<int>
      particle;              ///< S: corners with the face at the left, cells counter-clockwise, the outer clockwise; of
                             ///< a thick end, the end that is no corner
  std::vector<int> element;  ///< S: from a corner to the next one; a thick end
  /// Whether the last, the outer one, has all its corners; else those of the band and of its neighbours.
  bool is_outer_whole = true;

  // Faces beside each other, which are watched together; the outer face is the last and alone.
  std::vector<int> group_offset;   ///< G + 1, into faces
  std::vector<int> member_offset;  ///< G + 1, into members
  std::vector<int> member;         ///< particles at the faces of a group, each once

  [[nodiscard]] int count() const { return static_cast<int>(offset.size()) - 1; }
  [[nodiscard]] int group_count() const { return static_cast<int>(group_offset.size()) - 1; }
  [[nodiscard]] int corner_count(int face) const { return corner_end[face] - offset[face]; }
};

/// An element and the face into which its round end stands out.
struct ThickEnd {
  int element = 0;
  int face = 0;  ///< among all faces
};

/// A particle of the outer border of a lattice that is cut into bands.
struct BorderParticle {
  int particle = 0;
  int band = 0;       ///< that owns it
  int last_band = 0;  ///< of the elements there
};

/// The faces that elements make of the plane, for the search of contacts (search/face_search.h): the cells and the
/// outer border. E elements. Built by build_contact_faces; empty where contacts are searched by buckets.
struct ContactFaces {
  /// Why faces are enough to search, or why they are not.
  enum class Premise {
    holds,
    no_contact,     ///< there is nothing to search
    not_asked,      ///< the case asks for buckets
    several_parts,  ///< parts that no element joins lie in each other's faces without bordering them
    not_closed,  ///< an element has the same face at both sides, or a face touches itself at a particle: trees, bridges
    not_planar   ///< elements cross without a particle
  };
  Premise premise = Premise::no_contact;

  std::vector<int> side;               ///< 2 E, the faces at the left and at the right of each element
  std::vector<ThickEnd> thick_ends;    ///< by element; empty where all walls are equally thick
  std::vector<FacesOfBand> bands;      ///< as Scene::bands
  std::vector<BorderParticle> border;  ///< band by band; empty where there is but one

  [[nodiscard]] bool are_enough() const { return premise == Premise::holds; }
};

}  // namespace cellcrush
