#pragma once

#include <filesystem>

namespace cellcrush::client {

/// Throws CommandError (refused) with a remedy when ffmpeg is not installed.
void check_ffmpeg();

/// Encodes frame_00000.png and so on of a folder as a movie, in the format of the file's name. Throws CommandError
/// (refused) when ffmpeg fails.
void encode_movie(const std::filesystem::path& frames, int frames_per_second, const std::filesystem::path& movie);

}  // namespace cellcrush::client
