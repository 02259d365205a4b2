#include "scene/unit_walls.h"

#include <algorithm>
#include <utility>

#include "beam/element_place.h"
#include "scene/mesh.h"

namespace cellcrush {
bool can_break(const std::vector<Material>& materials) {
  return std::ranges::any_of(materials, [](const Material& material) { return material.law.fails(); });
}

void divide_into_units(bool force_based, Layout& layout) {
  std::vector<LayoutWall> units;
  std::vector<int> wall_of;
  const std::size_t joints = layout.joints.size();
  std::vector<Vector2> between;
  for (std::size_t w = 0; w < layout.walls.size(); ++w) {
    const LayoutWall& wall = layout.walls[w];
    const int each = wall.rigid ? wall.elements : force_based && wall.elements % 2 == 0 ? 2 : 1;
    const int count = wall.elements / each;
    LayoutWall unit = wall;
    unit.elements = each;
    unit.bow = 0.0;
    for (int k = 0; k < count; ++k) {
      const double from = static_cast<double>(k) / count;
      const double to = static_cast<double>(k + 1) / count;
      unit.start = k == 0 ? wall.start : unit.end;
      unit.end = k + 1 == count ? wall.end : static_cast<int>(joints + between.size());
      unit.rise = rise_between(layout, wall, from, to);
      if (k + 1 < count) between.push_back(place_on(layout, wall, to));
      units.push_back(unit);
      wall_of.push_back(static_cast<int>(w));
    }
  }
  layout.joints.insert(layout.joints.end(), between.begin(), between.end());
  layout.walls = std::move(units);
  layout.order = ListOrder{{}, std::move(wall_of)}.after(layout.order);
  list_added_joints(layout);
}

void number_chains(Scene& scene) {
  scene.chain.resize(scene.element_count());
  visit_elements(scene, [&scene](const ElementPlace& place, int wall) {
    scene.chain[place.element] = scene.list_order.listed_wall(wall);
  });
  scene.listed_walls = static_cast<std::size_t>(1 + std::ranges::max(scene.chain));
  const auto walls = static_cast<int>(scene.walls.start.size());
  for (auto e = static_cast<std::size_t>(scene.rigid.first_element); e < scene.element_count(); ++e) {
    scene.chain[e] = scene.list_order.listed_wall(walls + static_cast<int>(e) - scene.rigid.first_element);
  }
}

}  // namespace cellcrush
