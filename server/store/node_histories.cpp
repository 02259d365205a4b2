#include "store/node_histories.h"

#include <functional>

#include "store/result_layout.h"

namespace cellcrush::store {
namespace {

struct NodeColumn {
  const char* name;
  double (v1::WatchedNode::*get)() const;
};

constexpr std::array<NodeColumn, kNodeColumnCount> kNodeColumns = {{
    {"ux_mm", &v1::WatchedNode::ux_mm},
    {"uy_mm", &v1::WatchedNode::uy_mm},
    {"rotation_rad", &v1::WatchedNode::rotation_rad},
    {"reaction_x_n", &v1::WatchedNode::reaction_x_n},
    {"reaction_y_n", &v1::WatchedNode::reaction_y_n},
    {"reaction_moment_n_mm", &v1::WatchedNode::reaction_moment_n_mm},
}};

Hdf5Handle make_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
          "Creating the group " + name};
}

}  // namespace

void NodeHistories::append(hid_t file, std::span<const v1::Sample> samples) {
  if (samples.empty() || samples.front().watched().empty()) return;
  if (written_.empty()) make_nodes(file, samples.front());
  std::vector<double> rows(samples.size());
  for (std::size_t node = 0; node < written_.size(); ++node) {
    for (std::size_t column = 0; column < kNodeColumns.size(); ++column) {
      for (std::size_t row = 0; row < samples.size(); ++row)
        rows[row] = std::invoke(kNodeColumns[column].get, samples[row].watched(static_cast<int>(node)));
      append_rows(written_[node].columns[column].id(), H5T_NATIVE_DOUBLE, rows.size(), rows.data());
    }
  }
}

void NodeHistories::make_nodes(hid_t file, const v1::Sample& sample) {
  nodes_ = make_group(file, "nodes");
  for (const v1::WatchedNode& watched : sample.watched()) {
    Node node;
    node.group = make_group(nodes_.id(), watched.node());
    for (std::size_t column = 0; column < kNodeColumns.size(); ++column)
      node.columns[column] =
          make_growing_dataset(node.group.id(), kNodeColumns[column].name, H5T_IEEE_F64LE, {}, {kHistoryChunkRows});
    written_.push_back(std::move(node));
  }
}

void NodeHistories::close() {
  if (written_.empty()) return;
  const std::string what = "Closing the result";
  for (Node& node : written_) {
    for (Hdf5Handle& column : node.columns) column.close(what);
    node.group.close(what);
  }
  nodes_.close(what);
}

}  // namespace cellcrush::store
