#include "store/part_histories.h"

#include <array>
#include <utility>

#include "store/result_layout.h"

namespace cellcrush::store {
namespace {

template <double (v1::WatchedNode::*kGet)() const>
constexpr PartColumn node_column(const char* name) {
  return {name, [](const v1::Sample& sample, int part) { return (sample.watched(part).*kGet)(); }};
}

template <double (v1::RigidWallSample::*kGet)() const>
constexpr PartColumn wall_column(const char* name) {
  return {name, [](const v1::Sample& sample, int part) { return (sample.rigid_walls(part).*kGet)(); }};
}

constexpr std::array kNodeColumns = {
    node_column<&v1::WatchedNode::ux_mm>("ux_mm"),
    node_column<&v1::WatchedNode::uy_mm>("uy_mm"),
    node_column<&v1::WatchedNode::rotation_rad>("rotation_rad"),
    node_column<&v1::WatchedNode::reaction_x_n>("reaction_x_n"),
    node_column<&v1::WatchedNode::reaction_y_n>("reaction_y_n"),
    node_column<&v1::WatchedNode::reaction_moment_n_mm>("reaction_moment_n_mm"),
};

constexpr std::array kWallColumns = {
    wall_column<&v1::RigidWallSample::displacement_mm>("displacement_mm"),
    wall_column<&v1::RigidWallSample::normal_force_n>("normal_force_n"),
    wall_column<&v1::RigidWallSample::tangential_force_n>("tangential_force_n"),
};

Hdf5Handle make_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
          "Creating the group " + name};
}

}  // namespace

constexpr PartKind kWatchedNodes = {"nodes", [](const v1::Sample& sample) { return sample.watched_size(); },
                                    [](const v1::Sample& sample, int part) { return sample.watched(part).node(); },
                                    kNodeColumns};
constexpr PartKind kRigidWalls = {"rigid_walls", [](const v1::Sample& sample) { return sample.rigid_walls_size(); },
                                  [](const v1::Sample& sample, int part) { return sample.rigid_walls(part).wall(); },
                                  kWallColumns};

void PartHistories::append(hid_t file, std::span<const v1::Sample> samples) {
  if (samples.empty() || kind_.count(samples.front()) == 0) return;
  if (written_.empty()) make_parts(file, samples.front());
  std::vector<double> rows(samples.size());
  for (std::size_t part = 0; part < written_.size(); ++part) {
    for (std::size_t column = 0; column < kind_.columns.size(); ++column) {
      for (std::size_t row = 0; row < samples.size(); ++row)
        rows[row] = kind_.columns[column].get(samples[row], static_cast<int>(part));
      append_rows(written_[part].columns[column].id(), H5T_NATIVE_DOUBLE, rows.size(), rows.data());
    }
  }
}

void PartHistories::make_parts(hid_t file, const v1::Sample& sample) {
  all_ = make_group(file, kind_.group);
  for (int i = 0; i < kind_.count(sample); ++i) {
    Part part;
    part.group = make_group(all_.id(), kind_.id(sample, i));
    for (const PartColumn& column : kind_.columns)
      part.columns.push_back(
          make_growing_dataset(part.group.id(), column.name, H5T_IEEE_F64LE, {}, {kHistoryChunkRows}));
    written_.push_back(std::move(part));
  }
}

void PartHistories::close() {
  if (written_.empty()) return;
  const std::string what = "Closing the result";
  for (Part& part : written_) {
    for (Hdf5Handle& column : part.columns) column.close(what);
    part.group.close(what);
  }
  all_.close(what);
}

}  // namespace cellcrush::store
