#include "terminal/lattice_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace cellcrush::client {

namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

std::string plural(int count, const char* noun) { return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s"); }

template <typename Regular>
std::string walls_text(const Regular& regular) {
  return fmt::format("{:.6g} mm long, {:.6g} mm thick", regular.side_mm(), regular.wall_thickness_mm());
}

template <typename Values>
std::string range_text(const Values& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low == *high ? fmt::format("{:.6g}", *low) : fmt::format("{:.6g} to {:.6g}", *low, *high);
}

// The first names of a list, and how many more there are.
template <typename Names>
std::string names_text(const Names& names) {
  constexpr int kShown = 6;
  const auto end = names.begin() + std::min(static_cast<int>(names.size()), kShown);
  std::string text = fmt::format("{}", fmt::join(names.begin(), end, ", "));
  if (static_cast<int>(names.size()) > kShown)
    text += fmt::format(" and {} more", static_cast<int>(names.size()) - kShown);
  return text;
}

std::string support_text(const v1::Frame::Support& support) {
  std::vector<const char*> held;
  if (support.fix_x()) held.push_back("x");
  if (support.fix_y()) held.push_back("y");
  if (support.fix_rotation()) held.push_back("rotation");
  return fmt::format("{} ({})", support.node(), fmt::join(held, " "));
}

const char* component_text(v1::Frame::Component component) {
  switch (component) {
    case v1::Frame::COMPONENT_X: return "x";
    case v1::Frame::COMPONENT_Y: return "y";
    case v1::Frame::COMPONENT_ROTATION: return "rotation";
    default: return "?";
  }
}

template <typename Range, typename Text>
std::vector<std::string> texts_of(const Range& range, Text text) {
  std::vector<std::string> texts;
  for (const auto& item : range) texts.push_back(text(item));
  return texts;
}

void describe_masses(const v1::Frame& frame, Lines& lines) {
  const auto has_mass = [](const v1::Frame::Node& node) {
    return node.attached_mass_g() > 0.0 || node.attached_inertia_g_mm2() > 0.0;
  };
  const auto count = std::count_if(frame.nodes().begin(), frame.nodes().end(), has_mass);
  if (count > 0) lines.emplace_back("attached masses", "on " + plural(static_cast<int>(count), "node"));
}

void describe_loads(const v1::Frame& frame, Lines& lines) {
  const auto moved = [](const auto& load) {
    return fmt::format("{} ({})", load.node(), component_text(load.component()));
  };
  if (frame.loads_size() > 0) lines.emplace_back("forces and moments", names_text(texts_of(frame.loads(), moved)));
  if (frame.motions_size() > 0) lines.emplace_back("prescribed motion", names_text(texts_of(frame.motions(), moved)));
  if (frame.distributed_loads_size() > 0) {
    lines.emplace_back("distributed loads", plural(frame.distributed_loads_size(), "load"));
  }
  if (frame.initial_velocities_size() > 0) {
    const auto node = [](const v1::Frame::InitialVelocity& velocity) { return velocity.node(); };
    lines.emplace_back("initial velocities", names_text(texts_of(frame.initial_velocities(), node)));
  }
  if (frame.gravity_x_m_per_s2() != 0.0 || frame.gravity_y_m_per_s2() != 0.0) {
    lines.emplace_back("gravity", fmt::format("{} m/s2 along x, {} m/s2 along y", frame.gravity_x_m_per_s2(),
                                              frame.gravity_y_m_per_s2()));
  }
}

void describe_frame(const v1::Frame& frame, Lines& lines) {
  if (frame.beams_size() > 0) {
    std::vector<double> thicknesses;
    for (const auto& beam : frame.beams()) thicknesses.push_back(beam.thickness_mm());
    lines.emplace_back("beams", fmt::format("{}, {} mm thick", frame.beams_size(), range_text(thicknesses)));
  }
  int pins = 0;
  for (const auto& beam : frame.beams()) pins += (beam.pin_start() ? 1 : 0) + (beam.pin_end() ? 1 : 0);
  if (pins > 0) lines.emplace_back("pins", plural(pins, "end") + " of beams");
  lines.emplace_back("supports", frame.supports_size() == 0 ? std::string("none")
                                                            : names_text(texts_of(frame.supports(), support_text)));
  describe_masses(frame, lines);
  describe_loads(frame, lines);
  lines.emplace_back("contact between beams", frame.self_contact() ? "modelled" : "ignored");
  if (frame.rigid_walls_size() > 0) {
    const auto wall = [](const v1::Frame::RigidWall& of) {
      return of.id() + (of.has_displacement_mm() ? " (moves)" : "");
    };
    lines.emplace_back("rigid walls", names_text(texts_of(frame.rigid_walls(), wall)));
  }
  if (frame.watched_nodes_size() > 0) lines.emplace_back("watched nodes", names_text(frame.watched_nodes()));
  if (frame.has_end_time_s()) lines.emplace_back("end time", fmt::format("{} s", frame.end_time_s()));
}

template <typename Regular>
void describe_walls(const char* kind, const Regular& regular, Lines& lines) {
  lines.emplace_back(kind, fmt::format("{} x {} cells", regular.columns(), regular.rows()));
  lines.emplace_back("walls", walls_text(regular));
}

void describe_hexagon(const v1::Lattice::Hexagon& hexagon, Lines& lines) {
  describe_walls("hexagons", hexagon, lines);
  if (hexagon.has_vertical_wall_thickness_mm() && hexagon.vertical_wall_thickness_mm() != hexagon.wall_thickness_mm()) {
    lines.back().second += fmt::format("; along y {:.6g} mm", hexagon.vertical_wall_thickness_mm());
  }
}

void describe_changes(const v1::Lattice& lattice, Lines& lines) {
  const v1::Lattice::Imperfection& imperfection = lattice.imperfection();
  std::string offsets;
  if (imperfection.amplitude_mm() > 0.0) {
    offsets += fmt::format("joints displaced by up to {:.6g} mm, ", imperfection.amplitude_mm());
  }
  if (imperfection.bow_mm() > 0.0) offsets += fmt::format("walls bowed by up to {:.6g} mm, ", imperfection.bow_mm());
  if (!offsets.empty()) lines.emplace_back("imperfection", offsets + fmt::format("seed {}", imperfection.seed()));
  if (lattice.inclusions().rows_size() > 0) {
    std::string text = fmt::format("stiff cells in row{} {}", lattice.inclusions().rows_size() == 1 ? "" : "s",
                                   fmt::join(lattice.inclusions().rows(), ", "));
    if (lattice.inclusions().has_thickness_factor()) {
      text += fmt::format(", walls {} times as thick", lattice.inclusions().thickness_factor());
    }
    text += lattice.inclusions().model() == v1::Lattice::Inclusions::MESHED ? ", meshed" : ", rigid";
    lines.emplace_back("inclusions", std::move(text));
  }
}

}  // namespace

std::string lattice_summary(const v1::Lattice& lattice) {
  const auto cells = [](const char* kind, const auto& regular) {
    return fmt::format("{}, {} x {} cells", kind, regular.columns(), regular.rows());
  };
  switch (lattice.kind_case()) {
    case v1::Lattice::kHexagon: return cells("hexagons", lattice.hexagon());
    case v1::Lattice::kSquare: return cells("squares", lattice.square());
    case v1::Lattice::kTriangle: return cells("triangles", lattice.triangle());
    case v1::Lattice::kFrame:
      return fmt::format("frame of {} and {}", plural(lattice.frame().nodes_size(), "node"),
                         plural(lattice.frame().beams_size(), "beam"));
    default: return {};
  }
}

std::vector<std::pair<std::string, std::string>> lattice_description(const v1::Lattice& lattice) {
  Lines lines;
  switch (lattice.kind_case()) {
    case v1::Lattice::kHexagon: describe_hexagon(lattice.hexagon(), lines); break;
    case v1::Lattice::kSquare: describe_walls("squares", lattice.square(), lines); break;
    case v1::Lattice::kTriangle: describe_walls("triangles", lattice.triangle(), lines); break;
    case v1::Lattice::kFrame: describe_frame(lattice.frame(), lines); break;
    default: break;
  }
  describe_changes(lattice, lines);
  return lines;
}

}  // namespace cellcrush::client
