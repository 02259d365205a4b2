#include "case_file/drawn_lattice.h"


#include "case_file/case_source.h"
#include "command_error.h"
#include "drawing/drawing.h"
#include "drawing/import_lattice.h"

namespace cellcrush::client {

v1::ImportLatticeResponse read_drawn_lattice(const DrawingOptions& options) {
  v1::ImportLatticeRequest request;
  for (const std::string& name : options.files) {
    auto& file = *request.add_files();
    file.set_name(name);
    file.set_content(read_bytes(name));
  }
  request.set_unit(options.unit);
  if (options.thickness) request.set_thickness_mm(*options.thickness);
  if (options.tolerance) request.set_tolerance_mm(*options.tolerance);
  if (options.bond) request.set_bond(*options.bond);
  request.set_keep_crossings(options.keeps_crossings);
  try {
    return drawing::import_lattice(request);
  } catch (const drawing::DrawingError& error) {
    refuse(error.what());
  }
}

void replace_lattice(const v1::Lattice::Network& network, v1::Case& target) {
  target.mutable_lattice()->clear_inclusions();
  *target.mutable_lattice()->mutable_network() = network;
}

}  // namespace cellcrush::client
