#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <string>

#include "cellcrush/v1/sample.pb.h"
#include "columns/csv_text.h"

namespace cellcrush {

using Samples = google::protobuf::RepeatedPtrField<v1::Sample>;

/// Samples as CSV, one line each, with the columns of /history in result.h5, after a header line unless they continue
/// a file. Missing values (a front) are empty.
std::string history_csv(const Samples& samples, Decimal decimal = Decimal::point, bool with_header = true);

/// The watched nodes of samples as CSV, one line per node and sample; empty if no sample has any.
std::string nodes_csv(const Samples& samples, Decimal decimal = Decimal::point);

/// The rigid walls of samples as CSV, one line per wall and sample; empty if no sample has any.
std::string rigid_walls_csv(const Samples& samples, Decimal decimal = Decimal::point);

/// The grips of samples as CSV, one line per grip and sample; empty if no sample has any.
std::string grips_csv(const Samples& samples, Decimal decimal = Decimal::point);

/// A frame as CSV, one line per element: its ends, thickness and plastic fraction. REQUIRES: plain numbers.
std::string frame_csv(const v1::Mesh& mesh, const v1::FieldFrame& frame, Decimal decimal = Decimal::point);

}  // namespace cellcrush
