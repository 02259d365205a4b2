#include <gmock/gmock.h>

#include <functional>

#include "cellcrush/spec_checker.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> fields_noted(const std::function<void(SceneSpec&)>& change) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  change(spec);
  std::vector<std::string> fields;
  for (const Problem& note : find_implausible(spec)) fields.push_back(note.field);
  return fields;
}

TEST(Plausibility, PresetsAndSoundMaterialsAreNotNoted) {
  for (const auto& preset : scenes::presets()) EXPECT_THAT(find_implausible(preset.spec), IsEmpty()) << preset.name;
  struct Sound {
    double modulus, yield, density;
  };
  // Steel, titanium, nylon, tungsten, soft annealed copper.
  for (const Sound& sound : {Sound{210000, 800, 7850}, Sound{114000, 880, 4430}, Sound{2700, 60, 1140},
                             Sound{400000, 750, 19250}, Sound{117000, 33, 8960}}) {
    EXPECT_THAT(fields_noted([&](SceneSpec& spec) {
                  spec.material.youngs_modulus_mpa = sound.modulus;
                  spec.material.yield_stress_mpa = sound.yield;
                  spec.material.density_kg_per_m3 = sound.density;
                }),
                IsEmpty())
        << sound.modulus;
  }
}

TEST(Plausibility, UnitsThatAreMistakenAreAskedAboutByName) {
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.material.density_kg_per_m3 = 2.68; }),
              ElementsAre("material.density_kg_per_m3"));
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.material.density_kg_per_m3 = 2.7e-9; }),
              ElementsAre("material.density_kg_per_m3"));
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.material.density_kg_per_m3 = 270; }),
              ElementsAre("material.density_kg_per_m3"));
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.material.youngs_modulus_mpa = 70; }),
              ElementsAre("material.youngs_modulus_mpa", "material.yield_stress_mpa", "loading.speed_m_per_s"));
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.material.youngs_modulus_mpa = 69e9; }),
              ElementsAre("material.youngs_modulus_mpa", "material.yield_stress_mpa"));
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.material.yield_stress_mpa = 76e3; }),
              ElementsAre("material.yield_stress_mpa"));
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.material.yield_stress_mpa = 0.292; }),
              ElementsAre("material.yield_stress_mpa"));
}

TEST(Plausibility, WallsAndSpeedsBeyondTheModelAreNoted) {
  const auto walls = [](double share) {
    return fields_noted([share](SceneSpec& spec) {
      auto& hexagon = scenes::cells_of(spec);
      hexagon.wall_thickness_mm = share * *hexagon.side_mm;
    });
  };
  EXPECT_THAT(walls(0.26), ElementsAre("lattice.hexagon.wall_thickness_mm"));
  EXPECT_THAT(walls(0.24), IsEmpty());
  EXPECT_THAT(walls(0.0004), ElementsAre("lattice.hexagon.wall_thickness_mm"));
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.loading.speed_m_per_s = 600; }),
              ElementsAre("loading.speed_m_per_s"));
  EXPECT_THAT(fields_noted([](SceneSpec& spec) { spec.loading.speed_m_per_s = 400; }), IsEmpty());
}

TEST(Plausibility, ANoteSaysWhatMayBeMeant) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  spec.material.density_kg_per_m3 = 2.68;
  const auto notes = find_implausible(spec);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].value, "2.68");
  EXPECT_THAT(notes[0].message, HasSubstr("g/cm^3"));
  EXPECT_THAT(notes[0].remedy, HasSubstr("2680 kg/m^3"));
}

}  // namespace
}  // namespace cellcrush
