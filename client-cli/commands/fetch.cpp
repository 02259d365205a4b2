#include "commands/fetch.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "columns/history_csv.h"
#include "commands/commands.h"
#include "commands/result_download.h"
#include "connection/connection.h"
#include "connection/frames.h"
#include "terminal/case_text.h"
#include "terminal/number_text.h"
#include "terminal/output_file.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

namespace fs = std::filesystem;

// First bytes of the files that this command writes. A result begins as an HDF5 file; results of earlier daemons begin
// with a seal.
constexpr std::string_view kResultSeal = "CELLCRUSH RESULT ";
constexpr std::string_view kHdf5Signature = "\x89HDF\r\n\x1a\n";

constexpr const char* kCollection = "crush.pvd";
constexpr std::string_view kCaseSignature = "# Case of jobs/";
using Starts = std::initializer_list<std::string_view>;
constexpr Starts kResultStarts = {kResultSeal, kHdf5Signature};
const Starts kHistoryStarts = {"time_s,travel_mm,strain,", "time_s;travel_mm;strain;"};
const Starts kNodesStarts = {"time_s,node,ux_mm,", "time_s;node;ux_mm;"};
const Starts kRigidWallsStarts = {"time_s,wall,displacement_mm,", "time_s;wall;displacement_mm;"};
const Starts kGripsStarts = {"time_s,grip,displacement_x_mm,", "time_s;grip;displacement_x_mm;"};
const Starts kFrameStarts = {"element,x0_mm,y0_mm,", "element;x0_mm;y0_mm;"};

struct FetchOptions {
  std::string name;
  std::string folder;
  std::vector<double> frame_times;
  bool decimal_comma = false;
  bool vtp = false;
  bool vtu = false;
};

// Files that appear under their names once all are complete; until then the folder is unchanged.
class FetchedFiles {
 public:
  // A file that may replace one that begins with one of the signatures. Throws CommandError as OutputFile does.
  OutputFile& add(const fs::path& path, std::initializer_list<std::string_view> signatures) {
    return add(path, signatures, std::make_unique<OutputFile>(path));
  }

  // The same for one that an earlier command may have begun.
  OutputFile& add_continued(const fs::path& path, std::initializer_list<std::string_view> signatures) {
    const fs::path part = path.string() + ".part";
    std::error_code error;
    if (fs::file_size(part, error) > 0 && !error) check_may_overwrite(part, signatures);
    return add(path, signatures, OutputFile::continued(path));
  }

  // After it commit() needs no more room on the disk.
  void finish() {
    for (const auto& file : files_) file->finish();
  }

  // The first file is renamed last: whoever waits for it finds the others in place.
  void commit() {
    for (std::size_t i = files_.size(); i-- > 0;) files_[i]->commit();
  }

  [[nodiscard]] const std::vector<fs::path>& paths() const { return paths_; }

 private:
  OutputFile& add(const fs::path& path, std::initializer_list<std::string_view> signatures,
                  std::unique_ptr<OutputFile> file) {
    check_may_overwrite(path, signatures);
    paths_.push_back(path);
    return *files_.emplace_back(std::move(file));
  }

  std::vector<fs::path> paths_;
  std::vector<std::unique_ptr<OutputFile>> files_;
};

// The files that a collection of this command names.
std::set<std::string> files_of_collection(const fs::path& collection) {
  std::set<std::string> files;
  if (!begins_with_one_of(collection, {kVtkStart})) return files;
  const std::regex name("file=\"([^\"/]+)\"");
  std::ifstream file(collection);
  for (std::string line; std::getline(file, line);) {
    if (std::smatch found; std::regex_search(line, found, name)) files.insert(found[1]);
  }
  return files;
}

// Files that this command wrote before and does not overwrite now: those of another job would pass for this one's, and
// frames that the new crush.pvd no longer names for a part of its series. The case tells whether the folder belongs to
// the same job.
std::vector<fs::path> find_stale_files(const fs::path& folder, const std::string& case_text,
                                       const std::vector<fs::path>& written) {
  const fs::path case_file = folder / "case.txtpb";
  std::error_code error;
  const bool is_other_job = begins_with_one_of(case_file, {kCaseSignature}) && !holds_text(case_file, case_text);
  const bool has_series = std::ranges::find(written, folder / kCollection) != written.end();
  const auto series = has_series ? files_of_collection(folder / kCollection) : std::set<std::string>();
  std::vector<fs::path> stale;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_nodes = name == "nodes.csv" && begins_with_one_of(entry->path(), kNodesStarts);
    const bool is_walls = name == "rigid_walls.csv" && begins_with_one_of(entry->path(), kRigidWallsStarts);
    const bool is_grips = name == "grips.csv" && begins_with_one_of(entry->path(), kGripsStarts);
    const bool is_vtk = begins_with_one_of(entry->path(), {kVtkStart});
    // Those that are being written now have temporary endings.
    const std::string ending = entry->path().extension().string();
    const bool is_written = is_vtk ? ending == ".vtp" || ending == ".vtu"
                                   : ending == ".csv" && begins_with_one_of(entry->path(), kFrameStarts);
    const bool is_frame = (is_other_job && is_written && name.starts_with("frame_")) ||
                          (is_vtk && (series.contains(name) || (is_other_job && name == kCollection)));
    const bool is_kept = std::ranges::find(written, entry->path()) != written.end();
    if ((is_nodes || is_walls || is_grips || is_frame) && !is_kept) stale.push_back(entry->path());
  }
  std::ranges::sort(stale);
  return stale;
}

std::string frame_name(const MeshFrame& frame, const char* extension) {
  return fmt::format("frame_{:04}.{}", frame.frame.index(), extension);
}

void add_vtk(Connection& connection, const std::string& job, const fs::path& folder, VtkKind kind,
             FetchedFiles& files) {
  const int last = fetch_frame(connection, job, -1).frame.index();
  v1::FieldFrame undeformed;
  std::vector<std::pair<double, std::string>> written;
  for (int i = 0; i <= last; ++i) {
    const MeshFrame frame = fetch_frame(connection, job, i);
    if (i == 0) undeformed = frame.frame;
    written.emplace_back(frame.frame.time_s(), frame_name(frame, extension_of(kind)));
    OutputFile& file = files.add(folder / written.back().second, {kVtkStart});
    file.write(vtk_frame(frame, undeformed, kind));
    file.finish();  // lest all are open at once
  }
  files.add(folder / kCollection, {kVtkStart}).write(vtk_collection(written));
}

ExitCode run_fetch(Session& session, const FetchOptions& options) {
  const std::string name = session.find_job(options.name);
  Connection& connection = session.connection();
  const auto job = fetch_job(connection, name);
  ResultForm form{options.frame_times, decimal_of(options.decimal_comma), {}};
  if (options.vtp || options.vtu) form.vtk = options.vtu ? VtkKind::grid : VtkKind::lines;
  const auto files = write_results(connection, job, options.folder, form);
  if (session.json) {
    print_json(job);
    return ExitCode::done;
  }
  for (const fs::path& path : files.written) {
    fmt::print("{}  {}\n", path.string(), size_text(static_cast<std::int64_t>(fs::file_size(path))));
  }
  for (const fs::path& path : files.removed) fmt::print("{}  removed (of an earlier fetch)\n", path.string());
  return ExitCode::done;
}

}  // namespace

void check_may_write_results(const fs::path& folder) {
  check_may_overwrite(folder / "result.h5", kResultStarts);
  check_may_overwrite(folder / "history.csv", kHistoryStarts);
  check_may_overwrite(folder / "nodes.csv", kNodesStarts);
  check_may_overwrite(folder / "rigid_walls.csv", kRigidWallsStarts);
  check_may_overwrite(folder / "grips.csv", kGripsStarts);
  check_may_overwrite(folder / "case.txtpb", {kCaseSignature});
}

ResultFiles write_results(Connection& connection, const v1::Job& job, const fs::path& folder, const ResultForm& form) {
  const OutputFolder made(folder);  // outlives the files
  FetchedFiles files;
  OutputFile& result = files.add_continued(folder / "result.h5", kResultStarts);
  const std::string case_text = case_file_text(job.case_(), "Case of " + job.name());
  files.add(folder / "case.txtpb", {kCaseSignature}).write(case_text);
  const auto history = fetch_history(connection, job.name());
  files.add(folder / "history.csv", kHistoryStarts).write(history_csv(history.samples(), form.decimal));
  if (const std::string nodes = nodes_csv(history.samples(), form.decimal); !nodes.empty()) {
    files.add(folder / "nodes.csv", kNodesStarts).write(nodes);
  }
  if (const std::string walls = rigid_walls_csv(history.samples(), form.decimal); !walls.empty()) {
    files.add(folder / "rigid_walls.csv", kRigidWallsStarts).write(walls);
  }
  if (const std::string grips = grips_csv(history.samples(), form.decimal); !grips.empty()) {
    files.add(folder / "grips.csv", kGripsStarts).write(grips);
  }
  for (const double time : form.frame_times) {
    const MeshFrame frame =
        fetch_frame(connection, job.name(), [time](v1::GetFrameRequest& request) { request.set_time_s(time); });
    files.add(folder / frame_name(frame, "csv"), kFrameStarts).write(frame_csv(frame.mesh, frame.frame, form.decimal));
  }
  if (form.vtk) add_vtk(connection, job.name(), folder, *form.vtk, files);
  download_result(connection, job.name(), result);
  files.finish();
  // Deleted while the old case still identifies them: if interrupted in between, fetch finds them again.
  const auto stale = find_stale_files(folder, case_text, files.paths());
  for (const fs::path& path : stale) {
    std::error_code error;
    fs::remove(path, error);
    if (error) refuse(path.string() + ": cannot be removed: " + error.message());
  }
  files.commit();
  return {files.paths(), stale};
}

void add_fetch_command(CLI::App& app, Session& session) {
  const auto [command, options] = add_command<FetchOptions>(
      app, session, kResultCommands, "fetch",
      "Download a job's result.h5, history.csv, nodes.csv, rigid_walls.csv, grips.csv and case.txtpb", run_fetch);
  command->add_option("NAME", options->name, "Name of a job, or a result.h5 file or its folder")->required();
  add_option(*command, kOutputOptions, "-o,--output", options->folder, "Output folder, created if missing")->required();
  add_option(*command, kOutputOptions, "--frame", options->frame_times,
             "Also write the frame nearest to this time, in s, as CSV (may be repeated; default: none)")
      ->allow_extra_args(false);
  add_option(*command, kOutputOptions, "--decimal-comma", options->decimal_comma, kDecimalCommaHelp);
  auto* vtp = add_option(*command, kOutputOptions, "--vtk", options->vtp,
                         "Also write all frames for ParaView, as crush.pvd and .vtp files");
  add_option(*command, kOutputOptions, "--vtu", options->vtu, "Like --vtk, but as .vtu files, which meshio reads too")
      ->excludes(vtp);
  add_examples(*command, {"cellcrush fetch jobs/12 -o results", "cellcrush fetch jobs/12 -o results --frame 0.0005",
                          "cellcrush fetch jobs/12 -o results --vtk"});
}

}  // namespace cellcrush::client
