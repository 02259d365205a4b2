#include "fuzz/prepared_folder.h"

#include <fstream>

#include "cellcrush/v1/sample.pb.h"
#include "programs/text_proto.h"
#include "server/sample_writer.h"
#include "server/small_case.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/result_writer.h"

namespace cellcrush::fuzz {
namespace {

constexpr int kSamples = 5;
constexpr int kFrames = 3;

v1::Mesh mesh_of_two() {
  return testing::from_text<v1::Mesh>(
      "particle_count: 3 element_nodes: [0, 1, 1, 2] thickness_mm: [0.5, 0.25] "
      "element_wall: [0, 1]");
}

v1::Sample sample_at(int step) {
  v1::Sample out;
  out.set_step(step);
  out.set_time_s(step);
  out.set_strain(0.1 * step);
  if (step > 2) out.mutable_front()->set_strain_behind(0.9);
  return out;
}

v1::Job job_of(const v1::Case& submitted) {
  v1::Job out;
  *out.mutable_case_() = submitted;
  (*out.mutable_labels())["key"] = "value";
  out.set_owner("local");
  return out;
}

void change(store::Journal& journal, std::int64_t job, v1::Job::State state, bool has_result = false) {
  store::StateChange change;
  change.state = state;
  if (has_result) change.summary.emplace().set_step_count(kSamples);
  if (state == v1::Job::FAILED) {
    change.cause = v1::Job::WORKER_CRASHED;
    change.message = "It failed.";
    change.remedy = "Try again.";
  }
  journal.change_state(job, change);
}

void add_sweep(store::Journal& journal) {
  auto sweep = testing::from_text<v1::Sweep>(
      R"(owner: "local" axes { field: "loading.speed_m_per_s" list { values: [10, 20, 40] } })");
  *sweep.mutable_case_() = testing::tiny_case();
  std::vector<store::SweepJob> jobs;
  const auto job = [&sweep] { return job_of(sweep.case_()); };
  for (const double speed : sweep.axes(0).list().values()) jobs.push_back({job, {speed}, 1000});
  const auto made = journal.create_sweep(sweep, jobs, "of the sweep", "hash");
  change(journal, made.jobs[0], v1::Job::RUNNING);
  change(journal, made.jobs[0], v1::Job::FAILED);
  change(journal, made.jobs[1], v1::Job::CANCELLED);
  change(journal, made.jobs[2], v1::Job::SUSPENDED);
}

}  // namespace

void prepare_folder(const std::filesystem::path& root) {
  const store::DataFolder folder(root);
  store::Journal journal(folder.journal(), [](std::int64_t) {});
  for (int i = 0; i < 3; ++i)
    journal.create_job(job_of(testing::tiny_case()), "of job " + std::to_string(i), "hash", 9);
  change(journal, 2, v1::Job::RUNNING);
  journal.set_mesh(2, mesh_of_two());
  testing::SampleWriter reported(root);
  for (int step = 1; step <= kSamples; ++step) reported.add(journal, 2, sample_at(step));
  folder.make_job_folder(2);
  write_result(folder.job_folder(2).result());
  change(journal, 2, v1::Job::SUCCEEDED, true);
  folder.clean_job_folder(2);
  change(journal, 3, v1::Job::RUNNING);
  change(journal, 3, v1::Job::FAILED);
  add_sweep(journal);
}

void write_result(const std::filesystem::path& path) {
  store::ResultWriter writer(path, mesh_of_two());
  for (int step = 1; step <= kSamples; ++step) writer.add_sample(sample_at(step));
  for (int i = 0; i < kFrames; ++i) {
    v1::FieldFrame frame;
    frame.set_time_s(i);
    frame.set_strain(0.1 * i);
    for (int k = 0; k < 6; ++k) frame.add_position_mm(static_cast<float>(k));
    for (int k = 0; k < 2; ++k) frame.add_plastic_fraction(0.5F);
    for (int k = 0; k < 2; ++k) frame.add_fibre_strain(0.01F);
    for (int k = 0; k < 2; ++k) frame.add_local_strain(0.02F);
    writer.add_frame(frame);
  }
  writer.finish({job_of(testing::small_case()), "1.0", "scalar", 1, 1e-6, {"Walls are beams."}});
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace cellcrush::fuzz
