#include "validation/curve_file.h"

#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace cellcrush::validation {
namespace {

constexpr std::array<std::pair<const char*, double Sample::*>, 12> kColumns = {{
    {"strain", &Sample::strain},
    {"travel", &Sample::travel},
    {"stress_impact", &Sample::stress_impact},
    {"stress_support", &Sample::stress_support},
    {"work_external", &Sample::work_external},
    {"kinetic", &Sample::energy_kinetic},
    {"elastic", &Sample::energy_elastic},
    {"plastic", &Sample::energy_plastic},
    {"contact", &Sample::energy_contact},
    {"friction", &Sample::energy_friction},
    {"damping", &Sample::energy_damping},
    {"residual", &Sample::energy_residual},
}};

std::string first_line() {
  std::string line;
  for (const auto& [name, field] : kColumns) {
    line += (line.empty() ? "" : ",") + std::string(name);
  }
  return line;
}

}  // namespace

CurveFile::CurveFile(const std::string& file) : stream_(file) {
  stream_ << first_line() << std::endl;
  if (!stream_) {
    throw std::runtime_error(file + ": cannot be written; give a file in a folder that exists.");
  }
}

void CurveFile::add(const Sample& sample) {
  const char* separator = "";
  for (const auto& [name, field] : kColumns) {
    char text[32];
    std::snprintf(text, sizeof(text), "%s%.6g", std::exchange(separator, ","), sample.*field);
    stream_ << text;
  }
  stream_ << std::endl;
}

std::vector<Sample> read_curve(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  if (!stream || line != first_line()) {
    throw std::runtime_error(file + ": is no curve; validate writes one where curve=FILE is given.");
  }
  std::vector<Sample> samples;
  while (std::getline(stream, line) && !stream.eof()) {
    std::istringstream cells(line);
    Sample sample;
    for (const auto& [name, field] : kColumns) {
      cells >> sample.*field;
      cells.ignore();
    }
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace cellcrush::validation
