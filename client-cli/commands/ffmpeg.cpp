#include "commands/ffmpeg.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "command_error.h"

namespace cellcrush::client {

void check_ffmpeg() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((folder + "/ffmpeg").c_str(), X_OK) == 0) return;
  }
  throw CommandError(
      ExitCode::refused,
      "movie: ffmpeg is not installed; install it (apt-get install ffmpeg), or write the frames as numbered "
      "PNG files with --frames DIR instead of -o");
}

void encode_movie(const std::filesystem::path& frames, int frames_per_second, const std::filesystem::path& movie) {
  std::vector<std::string> words = {"ffmpeg",
                                    "-nostdin",
                                    "-y",
                                    "-loglevel",
                                    "error",
                                    "-framerate",
                                    std::to_string(frames_per_second),
                                    "-i",
                                    (frames / "frame_%05d.png").string(),
                                    "-pix_fmt",
                                    "yuv420p",
                                    movie.string()};
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  int status = -1;
  const int failure = posix_spawnp(&process, "ffmpeg", nullptr, nullptr, arguments.data(), environ);
  if (failure == 0) waitpid(process, &status, 0);
  if (failure == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw CommandError(ExitCode::refused,
                     "movie: ffmpeg could not write the movie; give -o a name that ends in .mp4, or "
                     "write the frames with --frames DIR");
}

}  // namespace cellcrush::client
