#pragma once

#include <string>
#include <vector>

namespace cellcrush::bench {

inline constexpr int kDefaultSeeds = 5;

/// A crush that is done in several ways: a preset and changes of it, in words that validation::read_options takes.
struct Variant {
  std::string name;  ///< "group:label", such as "elements:4"
  std::vector<std::string> words;
  int seeds = kDefaultSeeds;  ///< of random imperfections with which it is crushed: 1 to this
};

struct VariedScene {
  std::string name;
  std::vector<std::string> words;  ///< the preset, then changes that all variants have
  std::vector<Variant> variants;
};

/// Reads a list: "[scene] preset words..." begins a scene, the lines below it are "group:label words..."; # begins a
/// remark. A line that ends with @=a,b stands for two, with a and with b for every @; scenes of one line have the same
/// variants. A variant's word seeds=N is how many seeds it has. Throws std::invalid_argument that names the file and
/// the line on anything else, or when it cannot be read.
std::vector<VariedScene> read_variants(const std::string& file);

/// What a variant is run with for a seed: the scene's words, the variant's, the seed.
std::vector<std::string> words_of(const VariedScene& scene, const Variant& variant, int seed);

}  // namespace cellcrush::bench
