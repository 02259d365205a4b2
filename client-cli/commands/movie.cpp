#include <fmt/format.h>
#include <spawn.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "command_error.h"
#include "commands/commands.h"
#include "connection/frames.h"
#include "plots/job_picture.h"
#include "terminal/output_file.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

// Throws CommandError (refused) with a remedy when ffmpeg is not installed.
void check_ffmpeg() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((folder + "/ffmpeg").c_str(), X_OK) == 0) return;
  }
  refuse(
      "movie: ffmpeg is not installed; install it (apt-get install ffmpeg), or write the frames as numbered "
      "PNG files with --frames DIR instead of -o");
}

// Encodes frame_00000.png and so on of a folder as a movie, in the format of the file's name. Throws CommandError
// (refused) when ffmpeg fails.
void encode_movie(const std::filesystem::path& frames, int frames_per_second, const std::filesystem::path& movie) {
  const std::string rate = std::to_string(frames_per_second);
  const std::string pattern = frames / "frame_%05d.png";
  std::vector<std::string> words = {"ffmpeg",     "-nostdin", "-y", "-loglevel", "error",
                                    "-framerate", rate,       "-i", pattern};
  // A GIF has 256 colours: those that its frames have most of, and half the size.
  if (strcasecmp(movie.extension().c_str(), ".gif") == 0)
    words.insert(words.end(), {"-vf", "scale=iw/2:-1:flags=lanczos,split[a][b];[a]palettegen[p];[b][p]paletteuse"});
  else
    words.insert(words.end(), {"-pix_fmt", "yuv420p"});
  words.push_back(movie.string());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  int status = -1;
  const int failure = posix_spawnp(&process, "ffmpeg", nullptr, nullptr, arguments.data(), environ);
  if (failure == 0) waitpid(process, &status, 0);
  if (failure == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  refuse("movie: ffmpeg could not write the movie; write the frames with --frames DIR");
}

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
    if (mkdtemp(path_.data()) == nullptr) refuse(path_ + ": cannot create this folder");
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

fs::path frame_path(const fs::path& folder, int index) { return folder / fmt::format("frame_{:05}.png", index); }

// Draws all frames of a job as frame_00000.png and so on; returns their number. Fetches them twice, for the common box
// and for drawing, because the frames of a large lattice do not fit into memory together.
int draw_frames(Session& session, const std::string& job, const fs::path& folder) {
  const std::string name = session.find_job(job);
  Connection& connection = session.connection();
  const MeshFrame last = fetch_frame(connection, name, -1);
  const int count = last.frame.index() + 1;
  const RigidWalls rigid_walls = fetch_rigid_walls(connection, name);
  Box box = find_box({lattice_stage(last, rigid_walls)});
  for (int i = 0; i + 1 < count; ++i) {
    const Box other = find_box({lattice_stage(fetch_frame(connection, name, i), rigid_walls)});
    box = {std::min(box.low_x, other.low_x), std::max(box.high_x, other.high_x), std::min(box.low_y, other.low_y),
           std::max(box.high_y, other.high_y)};
  }
  for (int i = 0; i < count; ++i) {
    const MeshFrame frame = i + 1 < count ? fetch_frame(connection, name, i) : last;
    write_file(frame_path(folder, i), render_movie_frame(lattice_stage(frame, rigid_walls), box));
  }
  return count;
}

void keep_frames(Session& session, const MovieOptions& options) {
  const OutputFolder folder(options.folder);
  const int count = draw_frames(session, options.name, options.folder);
  // Those of an earlier, longer series would pass for frames of this one.
  for (int i = count; fs::remove(frame_path(options.folder, i)); ++i) continue;
  session.json ? print_file_json(options.folder, {{"frame_count", count}})
               : fmt::print("{}  {} frames\n", options.folder, count);
}

void make_movie(Session& session, const MovieOptions& options) {
  check_ffmpeg();
  const TemporaryFolder folder;
  const int count = draw_frames(session, options.name, folder.path());
  const fs::path movie = folder.path() / ("movie" + fs::path(options.file).extension().string());
  encode_movie(folder.path(), options.frames_per_second, movie);
  std::ostringstream bytes;
  bytes << std::ifstream(movie, std::ios::binary).rdbuf();
  write_file(options.file, bytes.str());
  session.json ? print_file_json(options.file, {{"frame_count", count}}) : fmt::print("{}\n", options.file);
}

ExitCode run_movie(Session& session, const MovieOptions& options) {
  if (options.file.empty() == options.folder.empty()) {
    refuse("movie: give either -o FILE.mp4, FILE.webm or FILE.gif, or --frames DIR");
  }
  if (options.folder.empty()) check_ending(options.file, {".mp4", ".webm", ".gif"});
  options.folder.empty() ? make_movie(session, options) : keep_frames(session, options);
  return ExitCode::done;
}

}  // namespace

void add_movie_command(CLI::App& app, Session& session) {
  const auto [command, options] = add_command<MovieOptions>(
      app, session, kResultCommands, "movie", "Render the frames of a job as a movie; requires ffmpeg", run_movie);
  command->add_option("NAME", options->name, "Name of a job, or a result.h5 file or its folder")->required();
  add_option(*command, kOutputOptions, "-o,--output", options->file,
             "Movie file: FILE.mp4, FILE.webm or FILE.gif (default: none; required without --frames)");
  add_option(*command, kOutputOptions, "--frames", options->folder,
             "Write the frames to this folder instead, as numbered PNG files of one size; does not require ffmpeg "
             "(default: none)");
  add_option(*command, kOutputOptions, "--fps", options->frames_per_second, "Frames per second (default: 10)")
      ->check(CLI::Range(1, 120));
  add_examples(*command, {"cellcrush movie jobs/12 -o crush.mp4", "cellcrush movie jobs/12 --frames frames"});
}

}  // namespace cellcrush::client
