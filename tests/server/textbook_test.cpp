#include "scenes/textbook.h"

#include <algorithm>
#include <functional>

#include "scenes/dynamic_frames.h"
#include "scenes/rigid_walls.h"
#include "server/daemon_fixture.h"
#include "store/hdf5.h"
#include "store/result_reader.h"
#include "translate/spec_to_case.h"

namespace cellcrush::testing {
namespace {

// The textbook frames as jobs: what a user submits, held against the same closed forms as in the solver's own tests.
class TextbookJobs : public DaemonFixture {
 protected:
  std::vector<Sample> run(const SceneSpec& spec) {
    auto client = this->client();
    job_ = client.create(translate::to_case(spec));
    const auto watched = client.watch(job_);
    EXPECT_TRUE(watched.status.ok()) << watched.status.error_message();
    std::vector<Sample> samples;
    for (const auto& event : watched.events) {
      if (event.has_sample()) samples.push_back(sample_of(event.sample()));
    }
    EXPECT_EQ(client.get(job_).state(), v1::Job::SUCCEEDED) << client.get(job_).cause_message();
    return samples;
  }

  static Sample sample_of(const v1::Sample& in) {
    Sample out;
    out.time = in.time_s();
    out.energies.kinetic = in.energy_kinetic_mj();
    out.energies.elastic = in.energy_elastic_mj();
    out.energies.plastic = in.energy_plastic_mj();
    out.energies.external = in.work_external_mj();
    for (const auto& node : in.watched()) {
      out.watched.push_back({node.ux_mm(), node.uy_mm(), node.rotation_rad(), node.reaction_x_n(), node.reaction_y_n(),
                             node.reaction_moment_n_mm()});
    }
    for (const auto& wall : in.rigid_walls())
      out.rigid_walls.push_back({wall.displacement_mm(), wall.normal_force_n(), wall.tangential_force_n()});
    return out;
  }

  /// Holds a dataset of the result to the samples.
  void expect_column(const char* name, const std::vector<Sample>& samples,
                     const std::function<double(const Sample& sample)>& value_of) {
    const auto path = (data_folder() / job_ / "result.h5").string();
    const store::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "Opening the result");
    const store::Hdf5Handle column(H5Dopen2(file.id(), name, H5P_DEFAULT), H5Dclose, "Opening the dataset");
    ASSERT_EQ(store::shape_of(column.id()), std::vector<hsize_t>{samples.size()});
    std::vector<double> values(samples.size());
    store::read_rows(column.id(), H5T_NATIVE_DOUBLE, 0, values.size(), values.data());
    for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(values[i], value_of(samples[i])) << name << " " << i;
  }

  std::string job_;
};

TEST_F(TextbookJobs, SectionLawAndCyclesHold) {
  scenes::expect_moment_curvature_law(run(scenes::bent_cantilever(1.5)), 1.5);
  scenes::expect_closed_cycles(run(scenes::cycled_bar(0.0, 0.004, 5)), 5);
  scenes::expect_shakedown(run(scenes::cycled_bar(1.0, 0.004, 10)), 10);
}

TEST_F(TextbookJobs, WatchedNodesStandInTheResultBesideTheHistory) {
  const std::vector<Sample> samples = run(scenes::cycled_bar(0.0, 0.004, 2));
  expect_column("/nodes/1/ux_mm", samples, [](const Sample& sample) { return sample.watched.front().ux; });
  expect_column("/nodes/1/reaction_x_n", samples,
                [](const Sample& sample) { return sample.watched.front().reaction_x; });
  EXPECT_NE(samples.back().watched.front().reaction_x, 0.0);  // its end is moved
}

TEST_F(TextbookJobs, RigidWallsStandInTheResultBesideTheHistory) {
  const std::vector<Sample> samples = run(scenes::TossedFrame::spec(0.3));
  const auto wall_of = [](const Sample& sample) { return sample.rigid_walls.at(0); };
  expect_column("/rigid_walls/0/displacement_mm", samples, [&](auto& sample) { return wall_of(sample).displacement; });
  expect_column("/rigid_walls/0/normal_force_n", samples, [&](auto& sample) { return wall_of(sample).normal_force; });
  expect_column("/rigid_walls/0/tangential_force_n", samples,
                [&](auto& sample) { return wall_of(sample).tangential_force; });
  EXPECT_GT(std::ranges::max(samples, {}, [&](auto& sample) { return wall_of(sample).normal_force; })
                .rigid_walls[0]
                .normal_force,
            0.0);
  EXPECT_NEAR(samples.back().rigid_walls[0].displacement, scenes::TossedFrame::kWallSpeed * samples.back().time, 1e-9);
}

TEST_F(TextbookJobs, AMassThatComesToRestOnHexagonsEndsTheRun) {
  const std::vector<Sample> samples = run(scenes::stopped_mass());
  EXPECT_LT(samples.back().time, 0.9 * *scenes::stopped_mass().loading.end_time_s);
  EXPECT_LT(samples.back().energies.kinetic, 1e-3 * samples.front().energies.kinetic);
  expect_column("/rigid_walls/0/displacement_mm", samples,
                [](auto& sample) { return sample.rigid_walls.at(0).displacement; });
  const auto read = store::ResultReader(data_folder() / job_ / "result.h5").history();
  EXPECT_EQ(read.back().rigid_walls(1).normal_force_n(), samples.back().rigid_walls.at(1).normal_force);
}

}  // namespace
}  // namespace cellcrush::testing
