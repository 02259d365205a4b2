#pragma once

#include <cstdint>
#include <string>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"

namespace cellcrush::scenes {

/// FNV-1a over the bits of every field of a state: equal bits, equal hash.
inline std::uint64_t hash_of(const State& state) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&](const auto& value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < sizeof(value); ++i) {
      hash = (hash ^ bytes[i]) * 1099511628211ULL;
    }
  };
  visit_fields(state, [&](const auto& field) {
    if constexpr (requires { field.begin(); }) {
      for (const auto& entry : field) {
        add(entry);
      }
    } else {
      add(field);
    }
  });
  return hash;
}

inline std::string checkpoint_of(const Simulation& simulation) {
  std::string out;
  simulation.checkpoint(append_to(out));
  return out;
}

}  // namespace cellcrush::scenes
