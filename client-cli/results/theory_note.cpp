#include "results/theory_note.h"

namespace cellcrush::client {

std::string theory_note(const v1::Lattice& lattice) {
  std::string note;
  if (lattice.has_square() || lattice.has_triangle()) {
    note = lattice.has_square() ? "Squares" : "Triangles";
    note +=
        " are stretch-dominated: the quasi-static stress is the axial yield stress of straight walls, an upper bound. "
        "Walls that buckle crush at a far lower stress, so neither it nor the shock theory built on it (Eq. 51) "
        "predicts the plateau.";
  }
  if (lattice.inclusions().rows_size() > 0) {
    note += note.empty() ? "" : " ";
    note += "The theory ignores the stiff cells.";
  }
  return note;
}

}  // namespace cellcrush::client
