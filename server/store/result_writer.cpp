#include "store/result_writer.h"

#include <fcntl.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <utility>

#include "columns/field_text.h"
#include "revision.h"
#include "store/case_hash.h"
#include "store/durable_file.h"
#include "store/result_seal.h"

namespace cellcrush::store {
namespace {

// Columns with scales: HDF5 lists in the scale of the time where it is used, and has room for four thousand entries.
constexpr std::size_t kMostScaled = 1000;

std::string as_json(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  std::string json;
  (void)google::protobuf::util::MessageToJsonString(message, &json, options);
  return json;
}

std::string as_lines(const std::vector<std::string>& sentences) {
  std::string out;
  for (const auto& sentence : sentences) out += (out.empty() ? "" : "\n") + sentence;
  return out;
}

}  // namespace

ResultWriter::ResultWriter(const std::filesystem::path& path, const v1::Mesh& mesh)
    : path_(path),
      particle_count_(static_cast<hsize_t>(mesh.particle_count())),
      element_count_(static_cast<hsize_t>(mesh.thickness_mm_size())),
      wall_count_(mesh.element_wall().empty() ? 0 : std::ranges::max(mesh.element_wall()) + hsize_t{1}) {
  silence_hdf5();
  const std::string what = "Creating " + path.string();
  const Hdf5Handle properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose, what);
  check_hdf5(H5Pset_sym_k(properties.id(), 0, kSealedLeaf), what);
  const OpenFile file = open_own(path, O_RDWR | O_CREAT | O_TRUNC);
  file_ = Hdf5Handle(H5Fcreate(path_of(file).c_str(), H5F_ACC_TRUNC, properties.id(), H5P_DEFAULT), H5Fclose, what);
  write_mesh(mesh);
  make_columns({});
  make_frames();
}

void ResultWriter::make_frames() {
  frame_time_ = make_growing_dataset(file_.id(), "frames/time_s", H5T_IEEE_F64LE, {}, {kHistoryChunkRows});
  frame_strain_ = make_growing_dataset(file_.id(), "frames/strain", H5T_IEEE_F64LE, {}, {kHistoryChunkRows});
  frame_position_ = make_growing_dataset(file_.id(), "frames/position_mm", H5T_IEEE_F32LE, {particle_count_, 2},
                                         {1, std::min<hsize_t>(particle_count_, kFrameChunkItems), 2});
  frame_plastic_ = make_growing_dataset(file_.id(), "frames/plastic_fraction", H5T_IEEE_F32LE, {element_count_},
                                        {1, std::min<hsize_t>(element_count_, kFrameChunkItems)});
  frame_fibre_strain_ = make_growing_dataset(file_.id(), "frames/fibre_strain", H5T_IEEE_F32LE, {wall_count_},
                                             {1, std::min<hsize_t>(wall_count_, kFrameChunkItems)});
  make_scale(frame_time_.id(), "time_s");
  attach_scales(frame_strain_.id(), {frame_time_.id()});
  attach_scales(frame_position_.id(), {frame_time_.id(), particles_.id(), axes_.id()});
  attach_scales(frame_plastic_.id(), {frame_time_.id(), elements_.id()});
  attach_scales(frame_fibre_strain_.id(), {frame_time_.id(), walls_.id()});
  describe(frame_time_.id(), "s", "simulated time of the frame; frame 0 is the undeformed lattice");
  describe(frame_strain_.id(), "", "nominal strain of the frame");
  describe(frame_position_.id(), "mm", "positions of the particles");
  describe(frame_plastic_.id(), "", "fraction of each element's section that has yielded");
  describe(frame_fibre_strain_.id(), "",
           "largest magnitude of the strain, elastic and plastic, in the outer fibres of each wall");
  for (auto* field : {&frame_position_, &frame_plastic_, &frame_fibre_strain_})
    write_attribute(field->id(), "coordinates", "strain");
}

void ResultWriter::make_local_strain() {
  frame_local_strain_ = make_growing_dataset(file_.id(), "frames/local_strain", H5T_IEEE_F32LE, {wall_count_},
                                             {1, std::min<hsize_t>(wall_count_, kFrameChunkItems)});
  attach_scales(frame_local_strain_.id(), {frame_time_.id(), walls_.id()});
  describe(frame_local_strain_.id(), "",
           "strain along the crush of the cells beside each wall, mean of both; absent without cells");
  write_attribute(frame_local_strain_.id(), "coordinates", "strain");
}

void ResultWriter::write_mesh(const v1::Mesh& mesh) {
  mesh_ = Hdf5Handle(H5Gcreate2(file_.id(), "mesh", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                     "Creating the group mesh");
  particles_ = make_dimension(file_.id(), "particle", particle_count_, "dimension scale without values");
  elements_ = make_dimension(file_.id(), "element", element_count_, "dimension scale without values");
  walls_ = make_dimension(file_.id(), "wall", wall_count_, "dimension scale without values");
  const Hdf5Handle ends =
      make_dimension(file_.id(), "end", 2, "dimension scale without values: start and end of an element");
  axes_ = write_dataset(file_.id(), "axis", H5T_C_S1, {2}, "xy");
  make_scale(axes_.id(), "axis");
  describe(axes_.id(), "", "axis of a position: x or y");
  const auto nodes =
      write_dataset(mesh_.id(), "beam_nodes", H5T_NATIVE_INT32, {element_count_, 2}, mesh.element_nodes().data());
  attach_scales(nodes.id(), {elements_.id(), ends.id()});
  describe(nodes.id(), "", "indices, from 0, of the particles at the start and the end of each element");
  const auto thickness =
      write_dataset(mesh_.id(), "thickness_mm", H5T_NATIVE_FLOAT, {element_count_}, mesh.thickness_mm().data());
  attach_scales(thickness.id(), {elements_.id()});
  describe(thickness.id(), "mm", "thickness of each element");
  const auto walls =
      write_dataset(mesh_.id(), "element_wall", H5T_NATIVE_INT32, {element_count_}, mesh.element_wall().data());
  attach_scales(walls.id(), {elements_.id()});
  describe(walls.id(), "", "number, from 0, of the wall of each element");
  if (const auto count = static_cast<hsize_t>(mesh.overlap_particle_size()); count > 0) {
    const auto overlaps =
        write_dataset(mesh_.id(), "overlap_particle", H5T_NATIVE_INT32, {count}, mesh.overlap_particle().data());
    describe(overlaps.id(), "", "particles, from 0, of walls that overlapped others before loading");
  }
  write_attribute(mesh_.id(), "rigid_element_count", static_cast<std::int64_t>(mesh.rigid_element_count()));
  write_attribute(mesh_.id(), "length_mm", mesh.length_mm());
  write_attribute(mesh_.id(), "width_mm", mesh.width_mm());
  write_attribute(mesh_.id(), "impact_plate_mm", mesh.impact_plate_mm());
  write_attribute(mesh_.id(), "support_plate_mm", mesh.support_plate_mm());
  write_attribute(mesh_.id(), "along_y", static_cast<std::int64_t>(mesh.along_y()));
  write_attribute(mesh_.id(), "side_low_mm", mesh.side_low_mm());
  write_attribute(mesh_.id(), "side_high_mm", mesh.side_high_mm());
  if (mesh.gripped().empty()) return;
  const auto gripped = write_dataset(mesh_.id(), "gripped", H5T_NATIVE_INT32,
                                     {static_cast<hsize_t>(mesh.gripped_size())}, mesh.gripped().data());
  describe(gripped.id(), "", "indices, from 0, of the particles that grips hold, grip by grip");
}

void ResultWriter::make_columns(const v1::Sample& sample) {
  const auto columns = history_columns(sample);
  for (std::size_t i = columns_.size(); i < columns.size(); ++i) {
    const HistoryColumn& column = columns[i];
    auto dataset = make_growing_dataset(file_.id(), column.path, column.type(), {}, {kHistoryChunkRows});
    describe(dataset.id(), unit_of(column.field->name()), meaning_of(*column.field));
    if (i == 0) {
      make_scale(dataset.id(), "time_s");
    } else if (i < kMostScaled) {
      attach_scales(dataset.id(), {columns_.front().second.id()});
      if (column.path.starts_with("history/")) {
        if (column.path != "history/strain") write_attribute(dataset.id(), "coordinates", "strain");
      } else if (const std::string time = column.group() + "/time_s"; !has_link(file_.id(), time)) {
        // netCDF looks for a dimension in the group of its variable and in those above.
        make_link(file_.id(), "history/time_s", time);
      }
    }
    columns_.emplace_back(column, std::move(dataset));
  }
}

void ResultWriter::add_sample(const v1::Sample& sample) {
  breaks_.insert(breaks_.end(), sample.breaks().begin(), sample.breaks().end());
  gathered_.push_back(sample);
  if (gathered_.size() >= kHistoryChunkRows) write_gathered();
}

void ResultWriter::write_gathered() {
  if (gathered_.empty()) return;
  make_columns(gathered_.front());
  std::vector<double> rows(gathered_.size());
  for (const auto& [column, dataset] : columns_) {
    std::ranges::transform(gathered_, rows.begin(), [&of = column](const auto& sample) { return of.get(sample); });
    append_rows(dataset.id(), H5T_NATIVE_DOUBLE, rows.size(), rows.data());
  }
  gathered_.clear();
}

void ResultWriter::add_frame(const v1::FieldFrame& frame) {
  const double time = frame.time_s();
  const double strain = frame.strain();
  append_rows(frame_time_.id(), H5T_NATIVE_DOUBLE, 1, &time);
  append_rows(frame_strain_.id(), H5T_NATIVE_DOUBLE, 1, &strain);
  append_rows(frame_position_.id(), H5T_NATIVE_FLOAT, 1, frame.position_mm().data());
  append_rows(frame_plastic_.id(), H5T_NATIVE_FLOAT, 1, frame.plastic_fraction().data());
  append_rows(frame_fibre_strain_.id(), H5T_NATIVE_FLOAT, 1, frame.fibre_strain().data());
  if (frame.local_strain_size() > 0) {
    if (!has_positions_) make_local_strain();
    append_rows(frame_local_strain_.id(), H5T_NATIVE_FLOAT, 1, frame.local_strain().data());
  }
  if (!std::exchange(has_positions_, true)) write_positions(frame);
  frame_breaks_.push_back(frame.broken_end_size());
  frame_ends_.insert(frame_ends_.end(), frame.end_position_mm().begin(), frame.end_position_mm().end());
}

void ResultWriter::write_breaks() {
  if (breaks_.empty()) return;
  const std::vector<BreakColumn> columns = break_columns();
  for (const BreakColumn& column : columns) {
    std::vector<double> values;
    for (const v1::Break& broken : breaks_) values.push_back(column.get(broken));
    const auto dataset = make_growing_dataset(file_.id(), column.path, column.type(), {}, {kHistoryChunkRows});
    describe(dataset.id(), unit_of(column.field->name()), meaning_of(*column.field));
    append_rows(dataset.id(), H5T_NATIVE_DOUBLE, values.size(), values.data());
  }
  const auto counts = make_growing_dataset(file_.id(), kFrameBreaks, H5T_STD_I64LE, {}, {kHistoryChunkRows});
  attach_scales(counts.id(), {frame_time_.id()});
  describe(counts.id(), "", "breaks that had happened by the frame");
  append_rows(counts.id(), H5T_NATIVE_INT64, frame_breaks_.size(), frame_breaks_.data());
  const auto ends = make_growing_dataset(file_.id(), kFrameEnds, H5T_IEEE_F32LE, {2}, {kFrameChunkItems, 2});
  describe(ends.id(), "mm", "positions of the ends of these breaks, in their order, frame after frame");
  append_rows(ends.id(), H5T_NATIVE_FLOAT, frame_ends_.size() / 2, frame_ends_.data());
}

void ResultWriter::write_positions(const v1::FieldFrame& frame) {
  const auto positions =
      write_dataset(mesh_.id(), "position_mm", H5T_NATIVE_FLOAT, {particle_count_, 2}, frame.position_mm().data());
  attach_scales(positions.id(), {particles_.id(), axes_.id()});
  describe(positions.id(), "mm", "undeformed positions of the particles");
}

void ResultWriter::write_identity(const ResultHeader& header) {
  const v1::Job& job = header.job;
  write_attribute(file_.id(), "title", job.case_().title());
  write_attribute(file_.id(), "name", job.name());
  write_attribute(file_.id(), "owner", job.owner());
  write_attribute(file_.id(), "create_time", google::protobuf::util::TimeUtil::ToString(job.create_time()));
  write_attribute(file_.id(), "citation", header.citation);
  write_attribute(file_.id(), "job", as_json(job));
  write_attribute(file_.id(), "case", as_json(job.case_()));
  write_attribute(file_.id(), "case_hash", hash_of(job.case_()));
}

void ResultWriter::finish(const ResultHeader& header) {
  write_gathered();
  write_breaks();
  write_identity(header);
  write_attribute(file_.id(), "modelled", as_lines(header.modelled));
  write_attribute(file_.id(), "format_version", kResultVersion);
  write_attribute(file_.id(), "solver_revision", header.solver_revision);
  write_attribute(file_.id(), "solver_version", kSolverVersion);
  write_attribute(file_.id(), "simd_target", header.simd_target);
  write_attribute(file_.id(), "device", header.device);
  write_attribute(file_.id(), "threads", static_cast<std::int64_t>(header.threads));
  write_attribute(file_.id(), "time_step_s", header.time_step_s);
  write_attribute(file_.id(), "complete", static_cast<std::int64_t>(header.job.state() == v1::Job::SUCCEEDED));
  if (!header.job.cause_message().empty()) write_attribute(file_.id(), "failure", header.job.cause_message());
  write_summary_attributes(file_.id(), header.job.summary());
  const std::string what = "Closing the result";
  for (auto& column : columns_) column.second.close(what);
  for (auto* part : {&frame_time_, &frame_strain_, &frame_position_, &frame_plastic_, &frame_fibre_strain_, &mesh_,
                     &particles_, &elements_, &walls_, &axes_, &frame_local_strain_}) {
    part->close(what);
  }
  check_hdf5(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), what);
  file_.close(what);
  seal_result(path_);
}

std::int64_t predicted_result_bytes(std::int64_t particles, std::int64_t elements, std::int64_t walls,
                                    std::int64_t samples, std::int64_t frames) {
  constexpr std::int64_t kStructure = 120'000;
  const std::int64_t history = static_cast<std::int64_t>(history_columns().size()) * 8 * samples;
  const std::int64_t mesh = 2 * 4 * particles + 4 * 4 * elements;
  const std::int64_t per_frame = 2 * 8 + 2 * 4 * particles + 4 * elements + 2 * 4 * walls;
  // Deflated, mesh and frames take 0.43 to 0.6 of that in crushes to 20 to 80 % strain.
  return kStructure + history + (mesh + frames * per_frame) / 2;
}

std::int64_t predicted_report_bytes(std::int64_t particles, std::int64_t elements, std::int64_t walls,
                                    std::int64_t samples, std::int64_t frames) {
  constexpr std::int64_t kSample = 490;  // as a message and in the binary form; measured
  const std::int64_t positions_and_numbers = 2 * 4 * particles + 4 * elements + 2 * 4 * walls;
  const std::int64_t nodes_and_walls = 3 * 3 * elements;
  return kSample * samples + nodes_and_walls + (frames + 1) * positions_and_numbers;
}

}  // namespace cellcrush::store
