#include "validation/curve_file.h"

#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace cellcrush::validation {
namespace {

struct CurveColumn {
  const char* name;
  double& (*of)(Sample&);
};

constexpr std::array<CurveColumn, 12> kColumns = {{
    {"strain", [](Sample& sample) -> double& { return sample.strain; }},
    {"travel", [](Sample& sample) -> double& { return sample.travel; }},
    {"stress_impact", [](Sample& sample) -> double& { return sample.stress_impact; }},
    {"stress_support", [](Sample& sample) -> double& { return sample.stress_support; }},
    {"work_external", [](Sample& sample) -> double& { return sample.energies.external; }},
    {"kinetic", [](Sample& sample) -> double& { return sample.energies.kinetic; }},
    {"elastic", [](Sample& sample) -> double& { return sample.energies.elastic; }},
    {"plastic", [](Sample& sample) -> double& { return sample.energies.plastic; }},
    {"contact", [](Sample& sample) -> double& { return sample.energies.contact; }},
    {"friction", [](Sample& sample) -> double& { return sample.energies.friction; }},
    {"damping", [](Sample& sample) -> double& { return sample.energies.mass_damping; }},  // of contacts and of masses
    {"residual", [](Sample& sample) -> double& { return sample.energies.residual; }},
}};

std::string first_line() {
  std::string line;
  for (const auto& [name, of] : kColumns) {
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

void CurveFile::add(Sample sample) {
  sample.energies.mass_damping += std::exchange(sample.energies.contact_damping, 0.0);
  const char* separator = "";
  for (const auto& [name, of] : kColumns) {
    char text[32];
    std::snprintf(text, sizeof(text), "%s%.6g", std::exchange(separator, ","), of(sample));
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
    for (const auto& [name, of] : kColumns) {
      cells >> of(sample);
      cells.ignore();
    }
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace cellcrush::validation
