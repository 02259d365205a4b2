#include "results/theory_note.h"

namespace cellcrush::client {

std::string theory_note(const v1::Lattice& lattice) {
  std::string note;
  if (lattice.has_square() || lattice.has_triangle()) {
    note = lattice.has_square() ? "Squares" : "Triangles";
    note +=
        " are stretch-dominated: the quasi-static stress is the axial yield stress of straight walls, an upper bound. "
        "If the walls buckle, the lattice crushes at a far lower stress. Then neither the quasi-static stress nor "
        "Eq. 51, which builds on it, predicts the plateau.";
  }
  if (lattice.inclusions().rows_size() > 0) {
    note += note.empty() ? "" : " ";
    note += "The theory ignores the stiff cells.";
  }
  return note;
}

}  // namespace cellcrush::client
