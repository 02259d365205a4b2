#include "bench/variants.h"

#include <charconv>
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

/// The lines for which one stands: of a last word @=a,b that is one with a for every @, and one with b.
std::vector<std::vector<std::string>> lines_of(std::vector<std::string> words) {
  if (!words.back().starts_with("@=")) return {words};
  std::istringstream values(words.back().substr(2));
  words.pop_back();
  std::vector<std::vector<std::string>> lines;
  for (std::string value; std::getline(values, value, ',');) {
    std::vector<std::string>& line = lines.emplace_back(words);
    for (std::string& word : line) {
      for (std::size_t at = 0; (at = word.find('@', at)) != std::string::npos; at += value.size()) {
        word.replace(at, 1, value);
      }
    }
  }
  return lines;
}

}  // namespace

std::vector<VariedScene> read_variants(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::invalid_argument(file + ": cannot be read; give a list of variants.");
  std::vector<VariedScene> scenes;
  std::size_t first = 0;  // of the scenes that have the variants below
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const auto refuse = [&](const char* what) {
      throw std::invalid_argument(file + ":" + std::to_string(number) + ": " + what);
    };
    const std::vector<std::string> given = split(line);
    if (given.empty()) continue;
    if (given.front().front() == '[') first = scenes.size();
    for (const std::vector<std::string>& words : lines_of(given)) {
      const std::string& name = words.front();
      if (name.front() == '[') {
        if (name.back() != ']' || words.size() < 2) refuse("is no scene; write [name] preset words...");
        scenes.push_back({name.substr(1, name.size() - 2), behind_first(words), {}});
        continue;
      }
      if (scenes.empty()) refuse("stands before the first scene; begin one with [name] preset words...");
      if (name.find(':') == std::string::npos) refuse("is no variant; write group:label words...");
      if (name.find(',') != std::string::npos) refuse("has a comma, which would part a cell; leave it out.");
      Variant variant = {name, behind_first(words)};
      std::erase_if(variant.words, [&](const std::string& word) {
        if (!word.starts_with("seeds=")) return false;
        const char* end = word.data() + word.size();
        const auto [read, error] = std::from_chars(word.data() + 6, end, variant.seeds);
        if (error != std::errc() || read != end || variant.seeds < 2) refuse("has no spread; give seeds=2 or more.");
        return true;
      });
      for (std::size_t i = first; i < scenes.size(); ++i) scenes[i].variants.push_back(variant);
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
