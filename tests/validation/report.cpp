// Pictures and tables of what validate has kept.
//   validation_report strip PICTURE strains=0.1,0.3,0.5 FILE.frames=TITLE ...  the lattice at strains, a row a crush
//   validation_report curves PICTURE along=travel FILE.csv=TITLE ...           stress against strain or travel
//   validation_report theory PICTURE tables=A.csv,B.csv PRESET/ELEMENTS        plateau against speed, Eq. 51 and 52
//   validation_report fits PICTURE tables=A.csv,B.csv PRESET/ELEMENTS ...      the same of several, quadratic fits
// A picture's name ends in .png or .svg.

#include <exception>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "bench/picture_file.h"
#include "validation/charts.h"
#include "validation/records.h"
#include "validation/strip.h"

namespace cellcrush::validation {
namespace {

using Words = std::vector<std::string>;

constexpr double kWidth = 960.0;
constexpr double kHeight = 420.0;
constexpr double kMargin = 12.0;
constexpr double kSlow = 60.0;  // m/s, the end of a chart of the slow crushes

/// The word's part behind "name=". Throws std::invalid_argument when it does not begin so.
std::string value_of(const std::string& word, const std::string& name) {
  if (!word.starts_with(name + "=")) {
    throw std::invalid_argument(word + ": is not " + name + "=...; see the usage.");
  }
  return word.substr(name.size() + 1);
}

Words split(const std::string& text, char separator) {
  Words parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

/// "FILE=TITLE"; without a title there is none.
std::pair<std::string, std::string> file_and_title(const std::string& word) {
  const std::size_t equals = word.find('=');
  return {word.substr(0, equals), equals == std::string::npos ? "" : word.substr(equals + 1)};
}

void strip(const std::string& picture, const Words& words) {
  std::vector<double> strains;
  for (const std::string& strain : split(value_of(words.at(0), "strains"), ',')) {
    strains.push_back(std::stod(strain));
  }
  std::vector<StripRow> rows;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto [file, title] = file_and_title(words[i]);
    rows.push_back({title, read_frames(file)});
  }
  draw_strip(picture, rows, strains);
}

void write_charts(const std::string& picture, const std::vector<client::Chart>& charts) {
  bench::write_picture(picture, kWidth, kHeight, [&](cairo_t* context) {
    const auto count = static_cast<double>(charts.size());
    const double width = (kWidth - (count + 1.0) * kMargin) / count;
    for (std::size_t i = 0; i < charts.size(); ++i) {
      const double x = kMargin + static_cast<double>(i) * (width + kMargin);
      client::draw_chart(context, {x, kMargin, width, kHeight - kMargin}, charts[i]);
    }
  });
}

void write_curves(const std::string& picture, const Words& words) {
  const std::string along = value_of(words.at(0), "along");
  if (along != "strain" && along != "travel") {
    throw std::invalid_argument("along=" + along + ": is not known; give strain or travel.");
  }
  std::vector<NamedCurve> curves;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto [file, title] = file_and_title(words[i]);
    curves.push_back({title, read_curve(file)});
  }
  write_charts(picture, {crush_chart(curves, along == "strain" ? &Sample::strain : &Sample::travel)});
}

void write_plateaus(const std::string& picture, const Words& words, bool with_theory) {
  const Words tables = split(value_of(words.at(0), "tables"), ',');
  std::vector<std::vector<Plateau>> presets;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const Words parts = split(words[i], '/');
    if (parts.size() != 2) throw std::invalid_argument(words[i] + ": is no mesh; give PRESET/ELEMENTS.");
    presets.push_back(read_plateaus(tables, parts[0], std::stoi(parts[1])));
  }
  const double fastest = presets.at(0).back().speed;
  write_charts(picture, with_theory ? std::vector{theory_chart(presets[0])}
                                    : std::vector{fit_chart(presets, kSlow), fit_chart(presets, fastest)});
}

void report(const Words& words) {
  const std::string& verb = words.at(0);
  const auto behind = [&](std::size_t count) {
    if (words.size() <= count) {
      throw std::invalid_argument(verb + ": too few words; see the usage.");
    }
    return Words(words.begin() + static_cast<std::ptrdiff_t>(count), words.end());
  };
  if (verb == "strip") {
    strip(words.at(1), behind(2));
  } else if (verb == "curves") {
    write_curves(words.at(1), behind(2));
  } else if (verb == "theory" || verb == "fits") {
    write_plateaus(words.at(1), behind(2), verb == "theory");
  } else {
    throw std::invalid_argument(verb + ": is not known; give strip, curves, theory or fits.");
  }
}

}  // namespace
}  // namespace cellcrush::validation

int main(int count, char** words) {
  try {
    cellcrush::validation::report({words + 1, words + count});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\nvalidation_report strip|curves|theory|fits ...\n";
    return 2;
  }
}
