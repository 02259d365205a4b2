#include <fmt/format.h>
#include <google/protobuf/struct.pb.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "chart/movie_frame.h"
#include "commands/commands.h"
#include "commands/ffmpeg.h"
#include "commands/resource_name.h"
#include "connection/frames.h"
#include "terminal/json_text.h"
#include "terminal/output_file.h"

namespace cellcrush::client {

namespace {

namespace fs = std::filesystem;

struct MovieOptions {
  std::string name;
  std::string file;
  std::string folder;
  int frames_per_second = 10;
};

// A folder that is deleted with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "cellcrush-movie-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw CommandError(ExitCode::refused, path_ + ": cannot create this folder");
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] fs::path path() const { return path_; }

 private:
  std::string path_;
};

MeshFrame fetch_frame_number(Connection& connection, const std::string& name, int number) {
  v1::GetFrameRequest request;
  request.set_name(name);
  request.set_index(number);
  return fetch_frame(connection, request);
}

void save_file(const fs::path& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

// Draws all frames of a job as frame_00000.png and so on; returns their number. Fetches them twice, for the common box
// and for drawing, because the frames of a large lattice do not fit into memory together.
int draw_frames(Connection& connection, const std::string& name, const fs::path& folder) {
  const MeshFrame last = fetch_frame_number(connection, name, -1);
  const int count = last.frame.index() + 1;
  Box box = find_box({last});
  for (int i = 0; i + 1 < count; ++i) {
    const Box other = find_box({fetch_frame_number(connection, name, i)});
    box = {std::min(box.low_x, other.low_x), std::max(box.high_x, other.high_x), std::min(box.low_y, other.low_y),
           std::max(box.high_y, other.high_y)};
  }
  for (int i = 0; i < count; ++i) {
    const MeshFrame frame = i + 1 < count ? fetch_frame_number(connection, name, i) : last;
    save_file(folder / fmt::format("frame_{:05}.png", i), render_movie_frame(frame, box));
  }
  return count;
}

void print_movie_json(const std::string& path, int frames) {
  google::protobuf::Struct json;
  (*json.mutable_fields())["path"].set_string_value(path);
  (*json.mutable_fields())["frame_count"].set_number_value(frames);
  print_json(json);
}

void keep_frames(Session& session, const MovieOptions& options) {
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error) throw CommandError(ExitCode::refused, options.folder + ": cannot create this folder: " + error.message());
  const int count = draw_frames(session.connection(), job_name(options.name), options.folder);
  session.json ? print_movie_json(options.folder, count) : fmt::print("{}  {} frames\n", options.folder, count);
}

void make_movie(Session& session, const MovieOptions& options) {
  check_ffmpeg();
  const TemporaryFolder folder;
  const int count = draw_frames(session.connection(), job_name(options.name), folder.path());
  const fs::path movie = folder.path() / ("movie" + fs::path(options.file).extension().string());
  encode_movie(folder.path(), options.frames_per_second, movie);
  std::ostringstream bytes;
  bytes << std::ifstream(movie, std::ios::binary).rdbuf();
  save_file(options.file, bytes.str());
  session.json ? print_movie_json(options.file, count) : fmt::print("{}\n", options.file);
}

ExitCode run_movie(Session& session, const MovieOptions& options) {
  if (options.file.empty() == options.folder.empty()) {
    throw CommandError(ExitCode::refused, "movie: give either -o FILE.mp4 or --frames DIR");
  }
  options.folder.empty() ? make_movie(session, options) : keep_frames(session, options);
  return ExitCode::done;
}

}  // namespace

void add_movie_command(CLI::App& app, Session& session) {
  const auto options = std::make_shared<MovieOptions>();
  CLI::App* command = add_command(app, session, "movie", "Render the frames of a job as a movie; requires ffmpeg",
                                  [&session, options] { return run_movie(session, *options); });
  command->group(kResultCommands);
  command->add_option("NAME", options->name, "Job name")->required();
  command
      ->add_option("-o,--output", options->file,
                   "Movie file, such as FILE.mp4 (default: none; required without --frames)")
      ->group(kOutputOptions);
  command
      ->add_option(
          "--frames", options->folder,
          "Write the frames to this folder instead, as numbered PNG files of one size; does not require ffmpeg "
          "(default: none)")
      ->group(kOutputOptions);
  command->add_option("--fps", options->frames_per_second, "Frames per second (default: 10)")
      ->group(kOutputOptions)
      ->check(CLI::Range(1, 120));
  add_examples(*command, {"cellcrush movie jobs/12 -o crush.mp4", "cellcrush movie jobs/12 --frames frames"});
}

}  // namespace cellcrush::client
