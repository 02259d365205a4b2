#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <string>

#include "cellcrush/v1/sample.pb.h"
#include "connection/frames.h"

namespace cellcrush::client {

/// The first line of a history file: the names of its columns, those of /history in result.h5 first.
std::string history_header();

/// Samples as CSV, a line each below the header; numbers are written so that they read back to the same bits, and
/// what a sample lacks (a front) is empty.
std::string history_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples);

/// The first line of a file of watched nodes.
std::string nodes_header();

/// The watched nodes of samples as CSV, a line for each node of each sample; empty when no sample has any.
std::string nodes_csv(const google::protobuf::RepeatedPtrField<v1::Sample>& samples);

/// The first line of a frame file.
std::string frame_header();

/// A frame as CSV, a line an element: its ends, thickness and plastic fraction.
std::string frame_csv(const MeshFrame& frame);

}  // namespace cellcrush::client
