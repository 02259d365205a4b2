#include "cellcrush/scene_spec.h"
#include "translate/case_to_spec.h"
#include "translate/fact_words.h"

namespace cellcrush::translate {
namespace {

std::string rigid_wall_text(const std::string& id, const LoadsSpec::RigidWall& wall) {
  std::vector<std::string> texts;
  if (wall.edge) texts.push_back(v1::Loading::Grip::Edge_Name(static_cast<int>(*wall.edge) + 1));
  for (const auto& [name, value] : wall.own) texts.push_back(fmt::format("{} {}", name, value));
  if (!wall.points.empty()) texts.emplace_back("moves");
  for (const auto& [name, points] : wall.functions) texts.push_back(name + " over time");
  return texts.empty() ? id : fmt::format("{} ({})", id, fmt::join(texts, ", "));
}

std::string grip_text(const v1::Loading::Grip& grip) {
  using Grip = v1::Loading::Grip;
  std::string text = fmt::format("{} ({}", grip.id(), Grip::Edge_Name(grip.edge()));
  if (grip.has_line_mm()) text += fmt::format(" from {} mm", grip.line_mm());
  if (grip.fixed_to() == Grip::IMPACT_PLATE) text += ", fixed to the impact plate";
  if (grip.fixed_to() == Grip::SUPPORT_PLATE) text += ", fixed to the support plate";
  if (grip.has_displacement_x_mm() || grip.has_displacement_y_mm()) text += ", moves";
  return text + ")";
}

void note_free_sides(v1::CaseWords& words) {
  words.set_theory_note(words.theory_note() + (words.theory_note().empty() ? "" : " ") +
                        "The theory is that of free sides.");
}

}  // namespace

void describe_loading(const v1::Loading& loading, v1::CaseWords& words) {
  if (loading.gravity_x_m_per_s2() != 0.0 || loading.gravity_y_m_per_s2() != 0.0) {
    add_fact(
        words, "gravity",
        fmt::format("{} m/s2 along x, {} m/s2 along y", loading.gravity_x_m_per_s2(), loading.gravity_y_m_per_s2()));
  }
  if (loading.velocity_x_m_per_s() != 0.0 || loading.velocity_y_m_per_s() != 0.0) {
    add_fact(words, "velocity at the start",
             fmt::format("{} m/s along x, {} m/s along y", loading.velocity_x_m_per_s(), loading.velocity_y_m_per_s()));
  }
  Problems ignored;
  const auto walls = read_rigid_walls(loading, ignored);
  words.set_rigid_wall_plates(!words.plates() && has_crushing_walls(walls));
  add_list(words, "rigid walls", loading.rigid_walls(),
           [&, i = 0](const auto& wall) mutable { return rigid_wall_text(wall.id(), walls[i++]); });
  if (loading.sides().kind() == v1::Loading::Sides::RIGID) {
    add_fact(
        words, "side walls",
        loading.sides().friction() > 0.0 ? fmt::format("rigid, friction {}", loading.sides().friction()) : "rigid");
    note_free_sides(words);
  }
  if (loading.sides().kind() == v1::Loading::Sides::PERIODIC) {
    const bool fixed = loading.sides().fixed_width();
    add_fact(words, "sides", fixed ? "periodic, of fixed width" : "periodic");
    if (fixed) note_free_sides(words);
  }
  add_list(words, "grips", loading.grips(), grip_text);
  std::string text;
  if (loading.has_end_time_s()) {
    add_fact(words, "end time", fmt::format("{} s", loading.end_time_s()));
    text = fmt::format("loaded for {} s", loading.end_time_s());
  }
  if (words.plates()) {
    const std::string pace =
        loading.quasi_static() ? "quasi-statically" : fmt::format("at {} m/s", loading.speed_m_per_s());
    text += fmt::format("{}crushed along {} {}", text.empty() ? "" : ", ",
                        loading.direction() == v1::Loading::Y ? 'Y' : 'X', pace);
    if (loading.has_end_strain()) text += fmt::format(" to strain {:.4g}", loading.end_strain());
  }
  if (loading.end_at_rest() > 0.0) {
    add_fact(words, "end at rest", fmt::format("at {} of the greatest kinetic energy", loading.end_at_rest()));
    text += ", or until at rest";
  }
  words.set_loading(std::move(text));
}

}  // namespace cellcrush::translate
