#include "bench/state_file.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace cellcrush::bench {
namespace {

std::runtime_error broken(const std::filesystem::path& file, const char* what) {
  return std::runtime_error(file.string() + ": " + what);
}

}  // namespace

void save_state(const std::filesystem::path& file, const State& state) {
  std::filesystem::create_directories(file.parent_path());
  std::string bytes;
  ByteWriter writer(bytes);
  put_state(writer, state);
  const std::filesystem::path partial = file.string() + ".partial";
  {
    std::ofstream stream(partial, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.flush();
    if (!stream) throw broken(file, "cannot be written; give --states a folder that can.");
  }
  std::filesystem::rename(partial, file);
}

std::optional<State> load_state(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  const std::string read = std::move(bytes).str();
  ByteReader reader(read);
  State state;
  take_state(reader, state);
  if (!reader.sound() || !reader.at_end()) throw broken(file, "is cut short; remove it.");
  return state;
}

}  // namespace cellcrush::bench
