#pragma once

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/problem.pb.h"
#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::fuzz {

/// Whether the case's mesh has more elements. To build a large one takes its time and tells the fuzzer nothing.
bool is_large(const v1::Case& given, double most_elements);

/// The same of a sweep's cases all together.
bool is_large(const v1::Sweep& given, double most_elements);

/// Aborts if one has no field, message or remedy.
void require_complete(const google::protobuf::RepeatedPtrField<v1::Problem>& problems);

}  // namespace cellcrush::fuzz
