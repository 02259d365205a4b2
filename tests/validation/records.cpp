#include "validation/records.h"

#include <array>
#include <cstdint>
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

constexpr std::uint64_t kMark = 0x32656d6172664343;  // "CCframe2"

/// The fields of a mesh, and those of a frame, in the order of the file.
template <class M, class Visitor>
void visit_mesh(M& mesh, Visitor&& visitor) {
  visitor(mesh.position);
  visitor(mesh.element_nodes);
  visitor(mesh.thickness);
  visitor(mesh.length);
  visitor(mesh.width);
  visitor(mesh.impact_plate);
  visitor(mesh.support_plate);
  visitor(mesh.along_y);
}

template <class F, class Visitor>
void visit_frame(F& frame, Visitor&& visitor) {
  visitor(frame.index);
  visitor(frame.time);
  visitor(frame.strain);
  visitor(frame.position);
  visitor(frame.plastic_fraction);
}

struct Writer {
  std::ofstream& stream;

  template <class Field>
  void operator()(const Field& field) const {
    if constexpr (requires { field.data(); }) {
      (*this)(static_cast<std::uint64_t>(field.size()));
      stream.write(reinterpret_cast<const char*>(field.data()),
                   static_cast<std::streamsize>(field.size() * sizeof(field[0])));
    } else {
      stream.write(reinterpret_cast<const char*>(&field), sizeof(field));
    }
  }
};

struct Reader {
  std::ifstream& stream;
  std::uint64_t bytes;  // of the file: no field is longer

  template <class Field>
  void operator()(Field& field) const {
    if constexpr (requires { field.data(); }) {
      std::uint64_t count = 0;
      (*this)(count);
      if (!stream || count > bytes / sizeof(field[0])) {
        stream.setstate(std::ios::failbit);
        return;
      }
      field.resize(count);
      stream.read(reinterpret_cast<char*>(field.data()), static_cast<std::streamsize>(count * sizeof(field[0])));
    } else {
      stream.read(reinterpret_cast<char*>(&field), sizeof(field));
    }
  }
};

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

FramesFile::FramesFile(const std::string& file, const MeshView& mesh) : stream_(file, std::ios::binary) {
  const Writer write{stream_};
  write(kMark);
  visit_mesh(mesh, write);
  stream_.flush();
  if (!stream_) {
    throw std::runtime_error(file + ": cannot be written; give a file in a folder that exists.");
  }
}

void FramesFile::add(const FieldFrame& frame) {
  visit_frame(frame, Writer{stream_});
  stream_.flush();
}

KeptFrames read_frames(const std::string& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const Reader read{stream, stream ? static_cast<std::uint64_t>(stream.tellg()) : 0};
  stream.seekg(0);
  std::uint64_t mark = 0;
  read(mark);
  KeptFrames kept;
  visit_mesh(kept.mesh, read);
  if (!stream || mark != kMark) {
    throw std::runtime_error(file + ": is no file of frames; validate writes one where frames=FILE is given.");
  }
  for (FieldFrame frame; visit_frame(frame, read), stream; frame = {}) {
    kept.frames.push_back(std::move(frame));
  }
  return kept;
}

}  // namespace cellcrush::validation
