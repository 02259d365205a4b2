#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <string>

#include "cellcrush/v1/sample.pb.h"
#include "connection/frames.h"

namespace cellcrush::client {

/// Samples as CSV, one line each, with the columns of /history in result.h5. Numbers read back to the same bits;
/// missing values (a front) are empty.
std::string history_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples);

/// How files of watched nodes begin, those of earlier versions too.
std::string nodes_signature();

/// The header line of a file of watched nodes.
std::string nodes_header();

/// The watched nodes of samples as CSV, one line per node and sample; empty if no sample has any.
std::string nodes_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples);

/// The header line of a file of rigid walls.
std::string rigid_walls_header();

/// The rigid walls of samples as CSV, one line per wall and sample; empty if no sample has any.
std::string rigid_walls_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples);

/// The header line of a frame file.
std::string frame_header();

/// A frame as CSV, one line per element: its ends, thickness and plastic fraction.
std::string frame_csv(const MeshFrame& frame);

}  // namespace cellcrush::client
