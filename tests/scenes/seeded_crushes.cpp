#include "scenes/seeded_crushes.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "cellcrush/state.h"
#include "measure/crush_mode.h"
#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

constexpr double kUnevenAt = 0.15;

double unevenness_of(const CollapseField& field) {
  std::array<double, 5> depth{};
  std::array<double, 5> cells{};
  for (std::size_t cell = 0; cell < field.collapsed.size(); ++cell) {
    if (!field.collapsed[cell]) {
      continue;
    }
    const double share = std::clamp(field.across[cell] / field.width, 0.0, 0.999);
    const auto strip = static_cast<std::size_t>(share * static_cast<double>(depth.size()));
    depth[strip] += field.along[cell];
    cells[strip] += 1.0;
  }
  // A strip where nothing has collapsed has depth 0: the band is then anything but straight.
  for (std::size_t strip = 0; strip < depth.size(); ++strip) {
    depth[strip] /= std::max(1.0, cells[strip]);
  }
  const auto [least, greatest] = std::ranges::minmax(depth);
  return (greatest - least) / field.pitch;
}

SeededCrush crush_once(const SceneSpec& spec) {
  const auto scene = build(spec);
  const Cells cells = find_cells(*scene);
  const auto interval = facts_of(*scene).sample_interval;
  Simulation simulation(scene);
  SeededCrush crush{spec.imperfection.seed};
  std::vector<Sample> samples;
  bool is_measured = false;
  while (simulation.status().kind == RunStatus::Kind::running &&
         (samples.empty() || samples.back().collapsed_fraction <= kModeTo)) {
    simulation.advance(interval);
    samples.push_back(simulation.take_sample());
    if (!is_measured && samples.back().collapsed_fraction >= kUnevenAt) {
      crush.unevenness = unevenness_of(find_collapse(cells, simulation.state().position));
      is_measured = true;
    }
  }
  crush.mode = summarize(*scene, samples).crush_mode;
  return crush;
}

}  // namespace

std::vector<SeededCrush> crush_with_seeds(SceneSpec spec, double amplitude_mm, int count) {
  std::vector<SeededCrush> crushes;
  for (int seed = 1; seed <= count; ++seed) {
    spec.imperfection = {amplitude_mm, static_cast<std::uint64_t>(seed)};
    crushes.push_back(crush_once(spec));
  }
  return crushes;
}

int count_of(const std::vector<SeededCrush>& crushes, CrushMode mode) {
  return static_cast<int>(std::ranges::count(crushes, mode, &SeededCrush::mode));
}

std::string describe(const std::vector<SeededCrush>& crushes) {
  std::string text;
  for (const SeededCrush& crush : crushes) {
    char unevenness[32];
    std::snprintf(unevenness, sizeof(unevenness), "%.1f", crush.unevenness);
    text += (text.empty() ? "seed " : ", seed ") + std::to_string(crush.seed) + ' ' + name_of(crush.mode) + ' ' +
            unevenness;
  }
  return text;
}

}  // namespace cellcrush::scenes
