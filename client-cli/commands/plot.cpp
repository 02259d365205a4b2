#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "case_file/case_source.h"
#include "case_file/typed_number.h"
#include "chart/display_text.h"
#include "commands/commands.h"
#include "connection/connection.h"
#include "connection/frames.h"
#include "plots/job_picture.h"
#include "results/sweep_results.h"
#include "results/test_difference.h"
#include "terminal/output_file.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

constexpr const char* kFrameOptions = "Frames";
constexpr const char* kTestOptions = "Test";

struct PlotOptions {
  std::vector<std::string> names;
  std::string file;
  std::vector<double> frame_strains;
  int strip = 0;  ///< frames evenly spaced over the run; 0: the default choice
  bool frames_only = false;
  bool wide = false;
  std::string logarithmic;  ///< the letters of the axes
  bool each = false;
  bool series = false;
  std::vector<std::string> tests;
  std::string columns;
  std::string window;
  std::optional<double> energy_to;
  std::string force;         ///< of which part; empty: stress between plates
  std::string displacement;  ///< of which part; empty: of the same
  PrintSize print;
};

// A job under the name that the user gave: its own, or the path of its result.
struct NamedJob {
  std::string name;
  v1::Job job;
};

JobHistory fetch_drawable_history(Connection& connection, const NamedJob& named) {
  const auto samples = fetch_history(connection, named.name);
  if (samples.samples_size() == 0) {
    refuse(named.job.name() + " has no samples to plot yet");
  }
  return {named.job, {samples.samples().begin(), samples.samples().end()}};
}

std::vector<MeshFrame> fetch_stages(Connection& connection, const std::string& name, const PlotOptions& options) {
  if (options.strip > 0) return fetch_strip(connection, name, options.strip);
  return options.frame_strains.empty() ? fetch_default_stages(connection, name)
                                       : fetch_stages_at(connection, name, options.frame_strains);
}

void plot_sweeps(Session& session, const PlotOptions& options) {
  const PictureFormat format = picture_format(options.file);
  Connection& connection = session.connection();
  std::vector<SweepResults> sweeps;
  for (const std::string& name : options.names) {
    sweeps.push_back({fetch_sweep(connection, name), fetch_table(connection, name)});
    if (session.json) print_json(sweeps.back().table);
    sweeps.back().table = charted_table(sweeps.back().table, options.each);
  }
  const auto has = [&](char axis) { return options.logarithmic.find(axis) != std::string::npos; };
  write_file(options.file, render_sweep_picture(format, sweeps, {has('x'), has('y')}, options.series, options.print));
  if (!session.json) fmt::print("{}\n", options.file);
}

std::string render_jobs(Connection& connection, PictureFormat format, const std::vector<NamedJob>& jobs,
                        const PlotOptions& options) {
  const NamedJob& first = jobs.front();
  if (options.frames_only) {
    return render_stages_picture(format, fetch_stages(connection, first.name, options),
                                 fetch_rigid_walls(connection, first.name), options.print);
  }
  std::vector<JobHistory> histories;
  histories.reserve(jobs.size());
  for (const NamedJob& job : jobs) histories.push_back(fetch_drawable_history(connection, job));
  if (histories.size() > 1) return render_comparison_picture(format, histories, options.print);
  const std::vector<MeshFrame> stages = fetch_stages(connection, first.name, options);
  if (options.wide && stages.empty()) {
    refuse(first.job.name() + " has no frames; plot it without --wide");
  }
  return options.wide ? render_wide_picture(format, histories.front(), stages, options.print)
                      : render_job_picture(format, histories.front(), stages, options.print);
}

void set_window(const std::string& text, v1::CompareTestRequest& request) {
  if (text.empty()) return;
  double low = 0.0;
  double high = 0.0;
  const auto comma = text.find(',');
  if (comma == std::string::npos || !parse_plain(text.substr(0, comma), low) ||
      !parse_plain(text.substr(comma + 1), high) || low < 0.0 || high <= low)
    refuse("plot: --window is \"" + text +
           "\"; give two strains or displacements, the smaller first: --window 0.2,0.4");
  request.set_window_low(low);
  request.set_window_high(high);
}

v1::CompareTestRequest request_of(const PlotOptions& options) {
  v1::CompareTestRequest request;
  for (const std::string& file : options.tests) {
    auto& test = *request.add_tests();
    test.set_name(valid_utf8(file));
    test.set_text(valid_utf8(read_bytes(file)));
  }
  request.set_columns(options.columns);
  set_window(options.window, request);
  if (options.energy_to) request.set_energy_to(*options.energy_to);
  request.set_force_part(options.force);
  request.set_displacement_part(options.displacement);
  return request;
}

TestOverlay overlay_of(const v1::CompareTestResponse& difference, const std::vector<std::string>& tests) {
  const auto list = [](const auto& values) { return std::vector<double>(values.begin(), values.end()); };
  TestOverlay out{"test: " + tests.front(), list(difference.x()), list(difference.measured_mean()), {}, {}};
  if (tests.size() == 1) return out;
  out.name = fmt::format("mean and band of {} tests", tests.size());
  out.least = list(difference.measured_least());
  out.most = list(difference.measured_most());
  return out;
}

// Writes the picture of jobs and tests, and prints how they differ.
void plot_tests(Session& session, const PlotOptions& options, const std::vector<NamedJob>& jobs) {
  Connection& connection = session.connection();
  v1::CompareTestRequest request = request_of(options);
  std::vector<JobHistory> histories;
  std::vector<v1::Job> compared;
  std::vector<v1::CompareTestResponse> differences;
  for (const NamedJob& job : jobs) {
    request.set_name(job.name);
    differences.push_back(connection.call(connection.jobs(), &v1::Jobs::Stub::CompareTest, request));
    compared.push_back(job.job);
    if (session.json) {
      print_json(differences.back());
    } else {
      fmt::print("{}{} {}", compared.size() > 1 ? "\n" : "", picture_name(job.job),
                 difference_table(differences.back(), fmt::format("{}", fmt::join(options.tests, ", "))));
    }
    if (options.force.empty()) histories.push_back(fetch_drawable_history(connection, job));
  }
  const PictureFormat format = picture_format(options.file);
  const TestOverlay test = overlay_of(differences.back(), options.tests);
  const std::string over =
      options.displacement.empty() ? "its displacement" : "the displacement of " + options.displacement;
  write_file(options.file, options.force.empty() ? render_comparison_picture(format, histories, options.print, test)
                                                 : render_force_picture(format, compared, differences,
                                                                        "force of " + options.force + " over " + over,
                                                                        options.print, test));
  if (!session.json) fmt::print("\n{}\n", options.file);
}

void plot_jobs(Session& session, const PlotOptions& options) {
  const PictureFormat format = picture_format(options.file);
  const auto names = session.find_jobs(options.names);
  Connection& connection = session.connection();
  std::vector<NamedJob> jobs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    jobs.push_back({names[i], fetch_job(connection, names[i])});
    if (names_file(options.names[i])) jobs.back().job.set_name(options.names[i]);
  }
  if (!options.tests.empty()) return plot_tests(session, options, jobs);
  write_file(options.file, render_jobs(connection, format, jobs, options));
  v1::ListJobsResponse printed;
  for (const NamedJob& job : jobs) *printed.add_jobs() = job.job;
  session.json ? print_json(printed) : fmt::print("{}\n", options.file);
}

void check_options(const PlotOptions& options) {
  const bool sweep = std::any_of(options.names.begin(), options.names.end(), names_sweep);
  const bool frames = options.strip > 0 || options.frames_only || options.wide || !options.frame_strains.empty();
  if (sweep && !std::all_of(options.names.begin(), options.names.end(), names_sweep)) {
    refuse("plot: jobs and sweeps cannot share a chart; name only jobs or only sweeps");
  }
  if (!options.tests.empty() && (sweep || frames)) {
    refuse("plot: --with compares curves of jobs; leave out sweeps, --strip, --frame-strain, --frames-only and --wide");
  }
  if (options.tests.empty() && (!options.columns.empty() || !options.window.empty() || options.energy_to ||
                                !options.force.empty() || !options.displacement.empty())) {
    refuse(
        "plot: --columns, --window, --energy-to, --force and --displacement apply to --with; give the file of a test");
  }
  if (!options.logarithmic.empty() && !sweep) refuse("plot: --log applies to sweeps only; leave it out");
  if ((options.each || options.series) && !sweep) refuse("plot: --each and --series apply to sweeps only");
  if (!options.print.is_default() && picture_format(options.file) == PictureFormat::png) {
    refuse("plot: --width and --font size a print; name the file .svg or .pdf");
  }
  constexpr double kNarrowest = 240.0;
  if (options.print.width(kNarrowest) < kNarrowest) {
    refuse(fmt::format("plot: --width {:.0f}mm leaves no room for a chart with a font of {} pt; use at least {:.0f}mm",
                       options.print.width_mm, options.print.font_pt,
                       std::ceil(kNarrowest * options.print.scale() / 96.0 * 25.4)));
  }
  if (frames && (sweep || options.names.size() > 1)) {
    refuse("plot: --strip, --frame-strain, --frames-only and --wide apply to a single job; name one");
  }
  if (options.frames_only && options.wide) refuse("plot: give either --frames-only or --wide");
  if (options.strip > 0 && !options.frame_strains.empty()) refuse("plot: give either --strip or --frame-strain");
}

ExitCode run_plot(Session& session, const PlotOptions& options) {
  check_options(options);
  names_sweep(options.names.front()) ? plot_sweeps(session, options) : plot_jobs(session, options);
  return ExitCode::done;
}

}  // namespace

void add_plot_command(CLI::App& app, Session& session) {
  const auto [command, options] = add_command<PlotOptions>(
      app, session, kResultCommands, "plot",
      "Plot a job's frames and stress-strain curve, compare several jobs, or plot sweeps", run_plot);
  command
      ->add_option("NAME", options->names,
                   "Names of jobs, results of `run` or `fetch` (result.h5 files or their folders), or sweeps over the "
                   "same field")
      ->required();
  add_option(*command, kOutputOptions, "-o,--output", options->file, "Picture file: FILE.svg, FILE.pdf or FILE.png")
      ->required();
  add_option(*command, kFrameOptions, "--frame-strain", options->frame_strains,
             "Show the frame nearest to this nominal strain (may be repeated; default: 0.2, 0.4 and the end)")
      ->allow_extra_args(false);
  add_option(*command, kFrameOptions, "--strip", options->strip,
             "Show this many frames, evenly spaced over the run (default: the frames of --frame-strain)")
      ->check(CLI::Range(1, 100));
  add_option(*command, kTestOptions, "--with", options->tests,
             "Compare with a test: a CSV file whose header names columns and units, of strain or displacement and of "
             "stress or force (may be repeated: mean and band of several)")
      ->allow_extra_args(false)
      ->type_name("FILE");
  add_option(
      *command, kTestOptions, "--columns", options->columns,
      "Columns of the test in order with their units, and - for others, such as \"-, displacement mm, force kN\" "
      "(default: its header)")
      ->type_name("LIST");
  add_option(*command, kTestOptions, "--window", options->window,
             "Nominal strains between which to compare mean stresses, or displacements in mm between which to compare "
             "mean forces (default: 0.2,0.4, or all)")
      ->type_name("LOW,HIGH");
  add_option(
      *command, kTestOptions, "--energy-to", options->energy_to,
      "Nominal strain, or displacement in mm, up to which to compare energies (default: as far as all curves go)")
      ->type_name("END");
  add_option(
      *command, kTestOptions, "--force", options->force,
      "Compare the force of a rigid wall (its id), or of a grip or a watched node (its id with .x or .y; several "
      "with +), instead of the stress between plates")
      ->type_name("PART");
  add_option(*command, kTestOptions, "--displacement", options->displacement,
             "Part whose displacement goes with --force (default: the same)")
      ->type_name("PART");
  add_option(*command, kOutputOptions, "--log", options->logarithmic,
             "Logarithmic axes of a sweep plot: x, y or xy (default: none)")
      ->check(CLI::IsMember({"x", "y", "xy"}));
  add_option(*command, kOutputOptions, "--each", options->each,
             "Draw each job of a sweep instead of means over the seeds");
  add_option(*command, kOutputOptions, "--series", options->series,
             "Draw a sweep over two fields as curves instead of a map");
  const std::map<std::string, double> lengths = {{"mm", 1.0}, {"cm", 10.0}, {"in", 25.4}};
  add_option(*command, kOutputOptions, "--width", options->print.width_mm,
             "Width in print, such as 85mm, 8.5cm or 3.3in; only for .svg and .pdf, and leaves out the title (default: "
             "the size for the screen)")
      ->type_name("LENGTH")
      ->transform(CLI::AsNumberWithUnit(lengths, CLI::AsNumberWithUnit::UNIT_REQUIRED).description(""))
      ->check(CLI::Range(20.0, 2000.0).description("20 to 2000 mm"));
  add_option(*command, kOutputOptions, "--font", options->print.font_pt,
             "Size of the text at the axes in print, such as 8pt; lines and markers scale with it (default: 9pt)")
      ->type_name("SIZE")
      ->transform(
          CLI::AsNumberWithUnit(std::map<std::string, double>{{"pt", 1.0}}, CLI::AsNumberWithUnit::UNIT_REQUIRED)
              .description(""))
      ->check(CLI::Range(4.0, 36.0).description("4 to 36 pt"));
  add_option(*command, kFrameOptions, "--frames-only", options->frames_only,
             "Draw the frames alone, without title and curve");
  add_option(*command, kFrameOptions, "--wide", options->wide,
             "Draw the frames beside the stress curves, as for a slide");
  add_examples(*command,
               {"cellcrush plot jobs/12 jobs/13 -o compared.svg", "cellcrush plot jobs/12 --with test.csv -o test.svg",
                "cellcrush plot sweeps/3 sweeps/4 --width 85mm --font 8pt -o sweeps.pdf"});
}

}  // namespace cellcrush::client
