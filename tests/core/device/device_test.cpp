// Crushes on a device, emulated: threads in an order that changes with every phase, and memory filled with bits of no
// number.
#include "cellcrush/device.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"
#include "scenes/whole_crushes.h"

namespace cellcrush {
namespace {

/// A state without what a device leaves out: the lists of the contact search, and flags that only save time.
State comparable(State state) {
  for (ContactLists& lists : state.contacts) {
    TouchMemory touching = lists.touching;
    for (int& place : touching.place) place = 0;
    lists = ContactLists();
    lists.touching = touching;
  }
  return state;
}

std::uint64_t hash_of(const State& state) { return scenes::hash_of(comparable(state)); }

bool has_fused_bits() { return scenes::bits_of_target(simd_target()) == "fused"; }

using scenes::whole_specimen;

SceneSpec with_friction_at_plates(SceneSpec spec) {
  spec.plates.friction = 0.3;
  return spec;
}

SceneSpec in_plane_strain(SceneSpec spec) {
  spec.material.plane = MaterialSpec::Plane::strain;
  return spec;
}

/// A Voronoi honeycomb: walls of any size, and no faces to search by.
SceneSpec uneven_cells() {
  SceneSpec spec = scenes::in_single_precision(whole_specimen("hexagon"));
  VoronoiWalls cells;
  cells.columns = 8;
  cells.rows = 6;
  cells.side_mm = 4.0;
  cells.irregularity = 0.2;
  cells.seed = 3;
  cells.wall_thickness_mm = 0.3464;
  spec.lattice = cells;
  spec.imperfection.amplitude_mm = 0.05;
  spec.numerics.rigid_link_slenderness = 0.0;
  spec.loading.end_strain = 0.08;
  return spec;
}

/// The crushes whose bits are recorded, as far as a device can advance them, and more.
std::vector<scenes::WholeCrush> crushes() {
  std::vector<scenes::WholeCrush> crushes = scenes::whole_crushes();
  std::erase_if(crushes, [](const scenes::WholeCrush& crush) {
    return why_not_on_device(*scenes::build(crush.spec)).has_value();
  });
  crushes.push_back({"friction at plates alone", with_friction_at_plates(whole_specimen("hexagon"))});
  crushes.push_back({"plane strain", in_plane_strain(whole_specimen("square"))});
  crushes.push_back({"cells of any size", uneven_cells()});
  return crushes;
}

class EmulatedDevice : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_fused_bits()) GTEST_SKIP() << "A device has the bits of processors with fused multiply-add.";
  }

  std::unique_ptr<DeviceEngine> engine_ = make_engine(make_emulated_device());
};

class CrushOnADevice : public EmulatedDevice, public testing::WithParamInterface<scenes::WholeCrush> {};

/// In pieces of any length, to the end.
TEST_P(CrushOnADevice, HasTheBitsOfAProcessor) {
  Simulation own(scenes::build(GetParam().spec));
  ASSERT_EQ(why_not_on_device(own.scene()), std::nullopt);
  Simulation on_device(scenes::build(GetParam().spec));
  on_device.use_device(*engine_);
  for (std::int64_t piece = 1; !own.has_ended(); piece = 2 * piece % 601) {
    own.advance(piece);
    on_device.advance(piece);
    ASSERT_EQ(on_device.device_failure(), "");
    ASSERT_EQ(hash_of(on_device.state()), hash_of(own.state())) << "at step " << own.step();
  }
  EXPECT_GT(own.state().contact_totals.deepest_penetration, 0.0);
  EXPECT_EQ(on_device.take_sample().energies.residual, own.take_sample().energies.residual);
}

INSTANTIATE_TEST_SUITE_P(Each, CrushOnADevice, testing::ValuesIn(crushes()), [](const auto& test) {
  std::string name = test.param.name;
  std::erase_if(name, [](unsigned char letter) { return std::isalnum(letter) == 0; });
  return name;
});

/// All of them but those with rigid parts, a curve or a rate.
TEST(DevicePremise, HoldsForMostOfTheRecordedCrushes) { EXPECT_EQ(crushes().size(), scenes::whole_crushes().size()); }

/// Crushed by any of them, one after the other.
TEST_F(EmulatedDevice, GoesOnWhereAProcessorStopsAndBack) {
  const SceneSpec spec = scenes::in_single_precision(whole_specimen("hexagon"));
  Simulation own(scenes::build(spec));
  Simulation changing(scenes::build(spec));
  std::string checkpoint;
  for (int piece = 0; !own.has_ended(); ++piece) {
    own.advance(60);
    if (piece % 2 == 1) changing.use_device(*engine_);
    changing.advance(60);
    EXPECT_EQ(hash_of(changing.state()), hash_of(own.state())) << "at step " << own.step();
    checkpoint = scenes::checkpoint_of(changing);
    changing = Simulation(scenes::build(spec));
    ASSERT_TRUE(changing.restore(source_of(checkpoint)));
  }
}

/// A device that ends after some calls.
class LostDevice final : public DeviceEngine {
 public:
  explicit LostDevice(int calls) : left_(calls) {}

  [[nodiscard]] std::string name() const override { return own_->name(); }
  std::unique_ptr<CrushOnDevice> begin(const Scene& scene, const State& state) override {
    return std::make_unique<Crush>(*this, own_->begin(scene, state));
  }

 private:
  class Crush final : public CrushOnDevice {
   public:
    Crush(LostDevice& device, std::unique_ptr<CrushOnDevice> own) : device_(device), own_(std::move(own)) {}

    std::optional<std::string> advance(std::int64_t steps) override {
      device_.count();
      return own_->advance(steps);
    }
    void take(State& state) const override {
      own_->take(state);
      device_.count();
    }

   private:
    LostDevice& device_;
    std::unique_ptr<CrushOnDevice> own_;
  };

  void count() {
    if (left_-- == 0) throw DeviceError("The device is lost.");
  }

  std::unique_ptr<DeviceEngine> own_ = make_engine(make_emulated_device());
  int left_;
};

TEST_F(EmulatedDevice, GoesOnWithoutADeviceThatIsLost) {
  for (const int calls : {0, 1, 6, 7}) {
    const SceneSpec spec = scenes::in_single_precision(whole_specimen("hexagon"));
    Simulation own(scenes::build(spec));
    Simulation changing(scenes::build(spec));
    LostDevice device(calls);
    changing.use_device(device);
    while (!own.has_ended()) {
      own.advance(100);
      changing.advance(100);
    }
    EXPECT_EQ(changing.device_failure(), "The device is lost.");
    EXPECT_EQ(hash_of(changing.state()), hash_of(own.state())) << "lost after " << calls;
  }
}

/// The search of the processor goes on otherwise from the step in which it finds them, and the run ends. Which step
/// that is depends on when it searches.
TEST_F(EmulatedDevice, LeavesWallsThatCrossToTheProcessor) {
  const auto too_soft = [] {
    std::shared_ptr<Scene> scene = scenes::build(scenes::spec_of({"hexagon", 200.0, 0.0}, 12, 6));
    scene->contact.stiffness *= 0.01;
    return scene;
  };
  Simulation own(too_soft());
  Simulation on_device(too_soft());
  on_device.use_device(*engine_);
  while (own.status().kind == RunStatus::Kind::running && !own.has_ended()) {
    own.advance(30);
    on_device.advance(30);
    own.take_sample();
    on_device.take_sample();
  }
  EXPECT_EQ(own.status().kind, RunStatus::Kind::wall_crossing);
  EXPECT_EQ(on_device.status().kind, RunStatus::Kind::wall_crossing);
  EXPECT_EQ(on_device.device_failure(), "walls crossed");
}

TEST(DevicePremise, SaysWhyACrushIsNotForADevice) {
  SceneSpec curved = whole_specimen("hexagon");
  curved.material.voce_stress_mpa = 50.0;
  curved.material.voce_exponent = 20.0;
  EXPECT_EQ(why_not_on_device(*scenes::build(curved)), "the yield stress of its material follows a curve or a rate");
  SceneSpec stiff = whole_specimen("hexagon");
  stiff.inclusions.rows = {2};
  EXPECT_EQ(why_not_on_device(*scenes::build(stiff)), "it has rigid parts");
}

}  // namespace
}  // namespace cellcrush
