#include <fmt/format.h>

#include <utility>

#include "chart/job_picture.h"
#include "commands/commands.h"
#include "terminal/job_text.h"
#include "terminal/json_text.h"
#include "terminal/output_file.h"

namespace cellcrush::client {

namespace {

struct PlotOptions {
  std::vector<std::string> names;
  std::string file;
  std::vector<double> frame_strains;
};

JobHistory fetch_job(Connection& connection, const std::string& name) {
  v1::GetJobRequest get;
  get.set_name(name);
  v1::GetHistoryRequest history;
  history.set_name(name);
  JobHistory result{connection.call(connection.jobs(), &v1::Jobs::Stub::GetJob, get), {}};
  const auto samples = connection.call(connection.jobs(), &v1::Jobs::Stub::GetHistory, history);
  result.samples.assign(samples.samples().begin(), samples.samples().end());
  if (result.samples.empty()) {
    throw CommandError(ExitCode::refused, name + " has no samples yet, so that there is nothing to draw");
  }
  return result;
}

MeshFrame fetch_frame_at(Connection& connection, const std::string& name, double strain) {
  v1::GetFrameRequest request;
  request.set_name(name);
  request.set_strain(strain);
  return fetch_frame(connection, request);
}

// The frames at the strains that were asked for; else those at 20 % and 40 % strain, if they are clearly before the last
// one, and the last one.
std::vector<MeshFrame> fetch_stages(Connection& connection, const std::string& name,
                                    const std::vector<double>& strains) {
  constexpr double kApart = 0.05;
  std::vector<MeshFrame> stages;
  for (const double strain : strains) stages.push_back(fetch_frame_at(connection, name, strain));
  if (!strains.empty()) return stages;
  v1::GetFrameRequest request;
  request.set_name(name);
  request.set_index(-1);
  const MeshFrame last = fetch_frame(connection, request);
  for (const double strain : {0.2, 0.4}) {
    if (strain >= last.frame.strain() - kApart) continue;
    MeshFrame stage = fetch_frame_at(connection, name, strain);
    // While a job runs the server may have fewer frames at hand.
    if (stage.frame.index() != last.frame.index()) stages.push_back(std::move(stage));
  }
  stages.push_back(last);
  return stages;
}

ExitCode run_plot(Session& session, const PlotOptions& options) {
  const PictureFormat format = picture_format(options.file);
  Connection& connection = session.connection();
  std::vector<JobHistory> histories;
  for (const std::string& name : options.names) histories.push_back(fetch_job(connection, job_name(name)));
  std::string picture;
  if (histories.size() == 1) {
    const auto stages = fetch_stages(connection, histories.front().job.name(), options.frame_strains);
    picture = render_job_picture(format, histories.front(), stages);
  } else {
    picture = render_comparison_picture(format, histories);
  }
  OutputFile file(options.file);
  file.write(picture);
  file.commit();
  if (!session.json) {
    fmt::print("{}\n", options.file);
    return ExitCode::done;
  }
  v1::ListJobsResponse drawn;
  for (const JobHistory& history : histories) *drawn.add_jobs() = history.job;
  print_json(drawn);
  return ExitCode::done;
}

}  // namespace

void add_plot_command(CLI::App& app, Session& session) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App* command =
      add_command(app, session, "plot", "Draw a job's crush and stress-strain curve, or compare the curves of several",
                  [&session, options] { return run_plot(session, *options); });
  command->add_option("NAME", options->names, "Names of jobs")->required();
  command->add_option("-o,--output", options->file, "The picture: FILE.svg or FILE.png")->required();
  command
      ->add_option("--frame-strain", options->frame_strains, "Show the frame nearest to this strain (may be repeated)")
      ->allow_extra_args(false);
}

}  // namespace cellcrush::client
