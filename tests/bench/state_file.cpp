#include "bench/state_file.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <type_traits>

namespace cellcrush::bench {
namespace {

std::runtime_error broken(const std::filesystem::path& file, const char* what) {
  return std::runtime_error(file.string() + ": " + what);
}

}  // namespace

void save_state(const std::filesystem::path& file, const State& state) {
  std::filesystem::create_directories(file.parent_path());
  const std::filesystem::path partial = file.string() + ".partial";
  {
    std::ofstream stream(partial, std::ios::binary);
    const auto put = [&](const void* from, std::size_t bytes) {
      stream.write(static_cast<const char*>(from), static_cast<std::streamsize>(bytes));
    };
    visit_fields(state, [&](const char*, const auto& field) {
      if constexpr (requires { field.data(); }) {
        const std::uint64_t count = field.size();
        put(&count, sizeof(count));
        put(field.data(), count * sizeof(field[0]));
      } else {
        put(&field, sizeof(field));
      }
    });
    stream.flush();
    if (!stream) throw broken(file, "cannot be written; give --states a folder that can.");
  }
  std::filesystem::rename(partial, file);
}

std::optional<State> load_state(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  State state;
  const auto take = [&](void* to, std::size_t bytes) {
    if (!stream.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) {
      throw broken(file, "is cut short; remove it.");
    }
  };
  visit_fields(state, [&](const char*, auto& field) {
    if constexpr (requires { field.data(); }) {
      std::uint64_t count = 0;
      take(&count, sizeof(count));
      field.resize(count);
      take(field.data(), count * sizeof(field[0]));
    } else {
      take(&field, sizeof(field));
    }
  });
  return state;
}

}  // namespace cellcrush::bench
