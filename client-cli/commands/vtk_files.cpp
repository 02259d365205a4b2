#include "commands/vtk_files.h"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <new>

namespace cellcrush::client {

namespace {

std::string_view bytes_of(const auto& numbers) {
  return {reinterpret_cast<const char*>(std::data(numbers)), std::size(numbers) * sizeof(*std::data(numbers))};
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      group = group << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63U];
  }
  return out;
}

// One compressed block: its count, size, partial size (none) and compressed size; then its bytes.
std::string compressed(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
               bytes.size()) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return base64(bytes_of(std::array<std::uint64_t, 4>{1, bytes.size(), 0, size})) + base64(out);
}

std::string vtk_array(const char* type, const char* name, const char* attributes, const auto& numbers) {
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" {} format=\"binary\">{}</DataArray>\n", type, name, attributes,
                     compressed(bytes_of(numbers)));
}

std::string vtk_number(const char* name, double value) {
  return vtk_array("Float64", name, "NumberOfTuples=\"1\"", std::array{value});
}

std::string vtk_walls(const MeshFrame& frame, VtkKind kind) {
  const auto& nodes = frame.mesh.element_nodes();
  std::vector<std::int32_t> ends;
  for (int i = 2; i <= nodes.size(); i += 2) ends.push_back(i);
  std::string text = vtk_array("Int32", "connectivity", "", nodes) + vtk_array("Int32", "offsets", "", ends);
  if (kind == VtkKind::lines) return "<Lines>\n" + text + "</Lines>\n";
  constexpr std::uint8_t kLine = 3;
  return "<Cells>\n" + text + vtk_array("UInt8", "types", "", std::vector(ends.size(), kLine)) + "</Cells>\n";
}

}  // namespace

const char* extension_of(VtkKind kind) { return kind == VtkKind::lines ? "vtp" : "vtu"; }

std::string vtk_frame(const MeshFrame& frame, const v1::FieldFrame& undeformed, VtkKind kind) {
  const auto& position = frame.frame.position_mm();
  std::vector<float> points;
  std::vector<float> displacements;
  // Broken ends are in the mesh of the frame alone.
  const auto before = [&](int i) {
    return i < undeformed.position_mm_size() ? undeformed.position_mm(i) : frame.mesh.position_mm(i);
  };
  for (int i = 0; i + 1 < position.size(); i += 2) {
    points.insert(points.end(), {position[i], position[i + 1], 0.0F});
    displacements.insert(displacements.end(), {position[i] - before(i), position[i + 1] - before(i + 1), 0.0F});
  }
  const bool lines = kind == VtkKind::lines;
  const char* type = lines ? "PolyData" : "UnstructuredGrid";
  const char* others = lines ? " NumberOfVerts=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"" : "";
  const std::string count =
      fmt::format("NumberOf{}=\"{}\"{}", lines ? "Lines" : "Cells", frame.mesh.thickness_mm_size(), others);
  constexpr const char* kThree = "NumberOfComponents=\"3\"";
  return fmt::format(
             "{}\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
             "compressor=\"vtkZLibDataCompressor\">\n<{}>\n<FieldData>\n",
             kVtkStart, type, type) +
         vtk_number("TimeValue", frame.frame.time_s()) + vtk_number("strain", frame.frame.strain()) +
         fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" {}>\n<PointData Vectors=\"displacement_mm\">\n",
                     position.size() / 2, count) +
         vtk_array("Float32", "displacement_mm", kThree, displacements) +
         "</PointData>\n<CellData Scalars=\"plastic_fraction\">\n" +
         vtk_array("Float32", "thickness_mm", "", frame.mesh.thickness_mm()) +
         vtk_array("Float32", "plastic_fraction", "", frame.frame.plastic_fraction()) + "</CellData>\n<Points>\n" +
         vtk_array("Float32", "position_mm", kThree, points) + "</Points>\n" + vtk_walls(frame, kind) +
         fmt::format("</Piece>\n</{}>\n</VTKFile>\n", type);
}

std::string vtk_collection(const std::vector<std::pair<double, std::string>>& files) {
  std::string text = fmt::format("{}\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n", kVtkStart);
  for (const auto& [time, file] : files)
    fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" file=\"{}\"/>\n", time, file);
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace cellcrush::client
