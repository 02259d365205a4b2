// Nets of which others have published the stiffness: Luan, Chen, John and Gaitanaros, "2D-Cellular-Metamaterials",
// computed with quadratic Timoshenko beams (Abaqus B22). A network between grips is held to the linear solution of its
// beams, by a sparse stiffness matrix. What is told differs from that by a factor, which is how their grips cut struts.
// Blind to: plastic flow, contact, and the size of joints.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "core/reference/beam_network.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::published_nets {
namespace {

// Of a square of 100 x 100 mm, cropped to 20 to 80 mm: what lies beyond the lines is held, or moved along y.
constexpr double kScale = 100.0;
constexpr double kLow = 27.5;
constexpr double kHigh = 72.5;
constexpr double kWidth = 60.0;
constexpr double kModulus = 10000.0;
constexpr double kPoissonsRatio = 0.3;
constexpr double kShearFactor = 0.85;
constexpr double kMotion = 1e-5 * (kHigh - kLow);

using Place = std::array<double, 2>;

struct Told {
  double density = 0.0;
  double thickness = 0.0;  // mm
  double modulus = 0.0;    // over that of the struts
};

struct Net {
  std::vector<Place> joints;
  std::vector<std::pair<int, int>> struts;
  std::vector<Told> told;
};

bool is_gripped(const Place& place) { return place[1] <= kLow || place[1] >= kHigh; }

/// The file of a net in tests/validation/published/nets.
Net read_net(const std::string& name) {
  std::ifstream file(std::string(CELLCRUSH_NETS) + "/" + name + ".txt");
  Net net;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "joints") {
      for (Place place; words >> place[0] >> place[1];) net.joints.push_back({kScale * place[0], kScale * place[1]});
    } else if (kind == "struts") {
      for (std::pair<int, int> strut; words >> strut.first >> strut.second;) net.struts.push_back(strut);
    } else if (kind == "told") {
      Told& told = net.told.emplace_back();
      words >> told.density >> told.thickness >> told.modulus;
      told.thickness *= kScale;
    }
  }
  EXPECT_EQ(net.told.size(), 5u) << name;
  return net;
}

/// The struts between the grips. One that reaches into a grip ends at the last of the nodes of their mesh, 20 elements
/// a strut, which that holds. Struts with a loose end bear nothing and are left out.
reference::BeamNetwork between_grips(const Net& net, double thickness) {
  reference::BeamNetwork out;
  std::vector<int> place_of(net.joints.size(), -1);
  const auto end_of = [&](int at, int other) {
    const Place& from = net.joints[at];
    const Place& to = net.joints[other];
    if (!is_gripped(from)) {
      if (place_of[at] < 0) {
        place_of[at] = static_cast<int>(out.joints.size());
        out.joints.push_back(from);
      }
      return place_of[at];
    }
    const auto node = [&](int k) {
      return Place{from[0] + (to[0] - from[0]) * k / 20.0, from[1] + (to[1] - from[1]) * k / 20.0};
    };
    int last = 0;
    while (is_gripped(node(last + 1))) ++last;
    out.joints.push_back(node(last));
    return static_cast<int>(out.joints.size()) - 1;
  };
  std::vector<int> walls_at(net.joints.size(), 0);
  std::vector<std::pair<int, int>> left = net.struts;
  for (bool is_shorter = true; is_shorter;) {
    std::ranges::fill(walls_at, 0);
    for (const auto& [start, end] : left) ++walls_at[start], ++walls_at[end];
    is_shorter =
        std::erase_if(left, [&](const auto& strut) {
          const auto is_loose = [&](int joint) { return walls_at[joint] == 1 && !is_gripped(net.joints[joint]); };
          return is_loose(strut.first) || is_loose(strut.second);
        }) > 0;
  }
  for (const auto& [start, end] : left) {
    if (is_gripped(net.joints[start]) && is_gripped(net.joints[end])) continue;
    const int first = end_of(start, end);
    out.walls.push_back({first, end_of(end, start), thickness});
  }
  return out;
}

/// Modulus of a specimen of unit depth of some stiffness, over that of its struts.
double modulus_of(double stiffness) { return stiffness / kWidth * (kHigh - kLow); }

double linear_modulus(reference::BeamNetwork network, bool shears) {
  if (shears) network.shear_flexibility = 2.0 * (1.0 + kPoissonsRatio) / kShearFactor;
  return modulus_of(reference::stiffness_between_grips(network, kLow, kHigh));
}

/// Of a run that is damped to rest.
double computed_modulus(const reference::BeamNetwork& network, const Told& told, bool shears) {
  NetworkWalls walls;
  for (const Place& joint : network.joints) walls.joints_mm.insert(walls.joints_mm.end(), joint.begin(), joint.end());
  for (const auto& wall : network.walls) walls.walls.insert(walls.walls.end(), {wall.start, wall.end});
  walls.wall_thickness_mm = told.thickness;
  SceneSpec spec = scenes::in_double_precision(scenes::plastic_frame({}, kModulus, 1e6, scenes::kDensity));
  spec.lattice = walls;
  spec.elements_per_wall = 1;
  spec.material.poissons_ratio = kPoissonsRatio;
  spec.section.shear_deformation = shears;
  if (shears) spec.section.shear_factor = kShearFactor;
  spec.numerics.rigid_link_slenderness = 0.0;
  const double wave_speed = std::sqrt(kModulus / (scenes::kDensity * 1e-12) * told.modulus / told.density);
  const double period = 2.0 * (kHigh - kLow) / wave_speed;
  using Edge = LoadsSpec::Edge;
  LoadsSpec::Grip top{Edge::top, kHigh};
  top.y_points = {{0.0, 0.0}, {2.0 * period, -kMotion}};
  spec.loads.grips = {{Edge::bottom, kLow}, top};
  spec.loading.end_time_s = 5.0 * period;
  spec.numerics.mass_damping_per_s = 2.0 * std::numbers::pi / period;
  spec.output.sample_count = 200;
  const Sample last = scenes::run_frame(spec).back();
  return modulus_of(-last.grips[1].force_y / (kMotion * kModulus));
}

struct Compared {
  std::string net;
  Told told;
  double linear[2] = {};    // without and with shear
  double computed[2] = {};  // the same
};

Compared compare(const std::string& name, const Net& net, const Told& told) {
  Compared out{name, told};
  const reference::BeamNetwork network = between_grips(net, told.thickness);
  for (const bool shears : {false, true}) {
    out.linear[shears ? 1 : 0] = linear_modulus(network, shears);
    out.computed[shears ? 1 : 0] = computed_modulus(network, told, shears);
  }
  return out;
}

double percent(double found, double expected) { return 100.0 * std::abs(found / expected - 1.0); }

/// Greatest over least, less 1, in %.
double spread_of(const std::vector<double>& ratios) {
  const auto [least, greatest] = std::ranges::minmax(ratios);
  return 100.0 * (greatest / least - 1.0);
}

TEST(PublishedNets, OfHexagonsIsAsStiffAsItsLinearSolution) {
  const Net net = read_net("hexagons");
  const Compared found = compare("hexagons", net, net.told[2]);
  scenes::record_bound("error in %", percent(found.computed[0], found.linear[0]), 0.3);
  scenes::record_bound("error with shear in %", percent(found.computed[1], found.linear[1]), 1.0);
}

TEST(PublishedNets, AreAsStiffAsTheirLinearSolutionsAtAllDensities) {
  std::vector<Compared> all;
  double spread = 0.0;  // of what is computed over what is told, over the densities of a net
  double spread_with_shear = 0.0;
  for (const char* name : {"squares", "triangles", "hexagons", "disordered"}) {
    const Net net = read_net(name);
    std::vector<double> without;
    std::vector<double> with;
    for (const Told& told : net.told) {
      all.push_back(compare(name, net, told));
      without.push_back(all.back().computed[0] / told.modulus);
      with.push_back(all.back().computed[1] / told.modulus);
    }
    spread = std::max(spread, spread_of(without));
    spread_with_shear = std::max(spread_with_shear, spread_of(with));
  }
  scenes::record_figure("at worst without shear in %", spread, 1);
  scenes::record_bound("at worst with shear in %", spread_with_shear, 1.0);
  double worst[2] = {};
  for (const Compared& each : all) {
    for (const int i : {0, 1}) worst[i] = std::max(worst[i], percent(each.computed[i], each.linear[i]));
  }
  scenes::record_bound("error at worst in %", worst[0], 0.3);
  scenes::record_bound("error at worst with shear in %", worst[1], 1.0);
  const char* const write = std::getenv("CELLCRUSH_WRITE_EVIDENCE");
  if (write == nullptr || std::string(write) != "1") return;
  std::ofstream file(std::string(CELLCRUSH_NETS) + "/../records/nets.csv");
  file << "net,density,told,linear,linear_shear,computed,computed_shear\n";
  file.precision(5);
  for (const Compared& each : all) {
    file << each.net << ',' << each.told.density << ',' << each.told.modulus << ',' << each.linear[0] << ','
         << each.linear[1] << ',' << each.computed[0] << ',' << each.computed[1] << '\n';
  }
}

}  // namespace
}  // namespace cellcrush::published_nets
