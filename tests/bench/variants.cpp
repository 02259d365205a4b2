#include "bench/variants.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace cellcrush::bench {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::istringstream stream(line.substr(0, line.find('#')));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> behind_first(const std::vector<std::string>& words) {
  return {words.begin() + 1, words.end()};
}

}  // namespace

std::vector<VariedScene> read_variants(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::invalid_argument(file + ": cannot be read; give a list of variants.");
  std::vector<VariedScene> scenes;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const auto refuse = [&](const char* what) {
      throw std::invalid_argument(file + ":" + std::to_string(number) + ": " + what);
    };
    const std::vector<std::string> words = split(line);
    if (words.empty()) continue;
    const std::string& first = words.front();
    if (first.front() == '[') {
      if (first.back() != ']' || words.size() < 2) refuse("is no scene; write [name] preset words...");
      scenes.push_back({first.substr(1, first.size() - 2), behind_first(words), {}});
    } else {
      if (scenes.empty()) refuse("stands before the first scene; begin one with [name] preset words...");
      if (first.find(':') == std::string::npos) refuse("is no variant; write group:label words...");
      if (first.find(',') != std::string::npos)
        refuse("has a comma, which would part a cell of the table; leave it out.");
      scenes.back().variants.push_back({first, behind_first(words)});
    }
  }
  return scenes;
}

std::vector<std::string> words_of(const VariedScene& scene, const Variant& variant, int seed) {
  std::vector<std::string> words = scene.words;
  words.insert(words.end(), variant.words.begin(), variant.words.end());
  words.push_back("seed=" + std::to_string(seed));
  return words;
}

}  // namespace cellcrush::bench
