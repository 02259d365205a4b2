#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "case_file/case_source.h"
#include "columns/result_columns.h"
#include "commands/commands.h"
#include "commands/creation.h"
#include "commands/sweep_axis.h"
#include "commands/watch.h"
#include "terminal/number_text.h"
#include "terminal/sweep_text.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

constexpr const char* kAmplitude = "lattice.imperfection.amplitude_mm";
constexpr int kMostElements = 64;  // of a wall
constexpr int kSeeds = 5;

struct ConvergeOptions {
  CaseOptions scene;
  std::vector<int> meshes;
  int seeds = 0;  ///< 0: kSeeds, of a frame 1
  double wanted_error = 0.05;
  bool only_cost = false;
  std::string executor;
  std::string request_id;
};

/// Three meshes, each twice as fine as the one before, with the one that a case has by itself in the middle; or first,
/// since walls of one element fold onto each other, or last.
std::vector<int> meshes_about_the_default(const v1::Case& of, Connection& connection) {
  v1::CheckCaseRequest request;
  *request.mutable_case_() = of;
  const auto check = connection.call(connection.cases(), &v1::Cases::Stub::CheckCase, request, kCheckPatience);
  if (!check.problems().empty()) {
    v1::ProblemList problems;
    *problems.mutable_problems() = check.problems();
    throw problems_error(std::move(problems));
  }
  const int own = check.completed_case().elements_per_wall();
  if (own < 4) return {own, 2 * own, 4 * own};
  if (own > kMostElements / 2) return {own / 4, own / 2, own};
  return {own / 2, own, 2 * own};
}

/// Refuses seeds or meshes that all give the same crush.
void refuse_idle_runs(const v1::Case& of, int seeds) {
  const v1::Lattice& lattice = of.lattice();
  if (lattice.has_frame() && seeds > 1) {
    refuse("a frame has no imperfection, so every seed gives the same run: leave out --seeds");
  }
  const auto& beams = lattice.frame().beams();
  if (!beams.empty() && std::ranges::all_of(beams, [](const v1::Frame::Beam& beam) { return beam.has_elements(); })) {
    refuse(
        "every beam sets its own elements, so elements_per_wall gives the same mesh: leave out elements of the beams");
  }
  if (seeds > 1 && lattice.imperfection().amplitude_mm() == 0.0 && lattice.imperfection().bow_mm() == 0.0) {
    refuse(
        fmt::format("{0} and bow_mm are 0, so every seed gives the same "
                    "crush: add --set {0}=0.01, or compare the meshes without "
                    "scatter by --seeds 1",
                    kAmplitude));
  }
}

v1::CreateSweepRequest build_request(ConvergeOptions& options, Connection& connection) {
  v1::CreateSweepRequest request;
  v1::Sweep& sweep = *request.mutable_sweep();
  sweep.set_executor(options.executor);
  *sweep.mutable_case_() = read_case(options.scene, connection);
  if (options.seeds == 0) options.seeds = sweep.case_().lattice().has_frame() ? 1 : kSeeds;
  refuse_idle_runs(sweep.case_(), options.seeds);
  if (options.meshes.empty()) options.meshes = meshes_about_the_default(sweep.case_(), connection);
  v1::SweepAxis& meshes = *sweep.add_axes();
  meshes.set_field("elements_per_wall");
  for (const int elements : options.meshes) meshes.mutable_list()->add_values(elements);
  if (options.seeds > 1) {
    v1::SweepAxis& seeds = *sweep.add_axes();
    seeds.set_field(kSeedField);
    seeds.set_seed_count(options.seeds);
  }
  return request;
}

ExitCode show_estimates(Session& session, const std::string& name, double wanted_error) {
  Connection& connection = session.connection();
  v1::GetConvergenceRequest request;
  request.set_name(name);
  request.set_wanted_error_relative(wanted_error);
  const auto convergence = connection.call(connection.sweeps(), &v1::Sweeps::Stub::GetConvergence, request);
  session.json ? print_json(convergence) : fmt::print("{}", convergence_text(convergence, terminal_width()));
  return ExitCode::done;
}

ExitCode run_converge(Session& session, ConvergeOptions options) {
  if (names_sweep(options.scene.source)) return show_estimates(session, options.scene.source, options.wanted_error);
  Connection& connection = session.connection();
  v1::CreateSweepRequest request = build_request(options, connection);
  const Interruption interruption;
  request.set_validate_only(true);
  const auto checked = connection.call(connection.sweeps(), &v1::Sweeps::Stub::CreateSweep, request, kCheckPatience);
  const std::string cost = fmt::format("{}, predicted to take {} of one core\n",
                                       run_count_text(static_cast<int>(options.meshes.size()) * options.seeds),
                                       duration_text(checked.predicted_seconds()));
  if (options.only_cost) {
    session.json ? print_json(checked) : fmt::print("{}", cost);
    return ExitCode::done;
  }
  if (!session.json) fmt::print(stderr, "{}{}", notes_text(checked.notes()), cost);
  request.set_validate_only(false);
  request.set_request_id(options.request_id);
  const std::string name =
      create(session, connection.sweeps(), &v1::Sweeps::Stub::CreateSweep, request, kCheckPatience).name();
  if (!session.json) {
    fmt::print("{}\n", name);
    std::fflush(stdout);
  }
  const WatchedSweep watched = show_sweep_to_its_end(session, name, interruption);
  if (!watched.complete) return ExitCode::interrupted;
  if (!session.json) fmt::print("\n");
  const ExitCode shown = show_estimates(session, name, options.wanted_error);
  return watched.all_succeeded ? shown : ExitCode::job_failed;
}

}  // namespace

void add_converge_command(CLI::App& app, Session& session) {
  const auto [converge, options] = add_command<ConvergeOptions>(app, session, kJobCommands, "converge",
                                                                "Estimate the mesh error of a case", run_converge);
  add_case_options(*converge, options->scene);
  converge->get_option("CASE")->description(
      "A case file, - for stdin, or preset:NAME; or sweeps/NAME, to print the estimates of a sweep over meshes again");
  add_option(*converge, kCaseOptions, "--meshes", options->meshes,
             "Elements per wall, or per beam of a frame, of the meshes to compare (default: those of the case, and "
             "twice or half "
             "as many)")
      ->delimiter(',')
      ->check(CLI::Range(1, kMostElements));
  add_option(*converge, kCaseOptions, "--seeds", options->seeds,
             "Number of runs with each mesh, with seeds 1 to N of the imperfection (default: 5; a frame has no seeds)")
      ->check(CLI::Range(1, 100));
  add_option(*converge, kOutputOptions, "--error", options->wanted_error,
             "Relative error that the plateau stresses, or the work of a frame, may have, above 0 and "
             "at most 1 "
             "(default: 0.05)")
      ->check(CLI::Range(1e-6, 1.0));
  add_executor_option(*converge, options->executor);
  add_option(*converge, kIdentityOptions, "--request-id", options->request_id,
             "Id of the request, up to 128 characters; asking again returns the same sweep (default: a new one)");
  add_option(*converge, kOutputOptions, "--cost", options->only_cost, "Print the predicted cost and queue nothing");
  add_examples(*converge, {"cellcrush converge preset:hexagon-small --set lattice.imperfection.amplitude_mm=0.01",
                           "cellcrush converge my.txtpb --meshes 4,8,16 --seeds 1 --cost",
                           "cellcrush converge sweeps/3 --error 0.02"});
}

}  // namespace cellcrush::client
