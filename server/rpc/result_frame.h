#pragma once

#include "cellcrush/v1/jobs_service.pb.h"
#include "store/result_reader.h"

namespace cellcrush::rpc {

/// The frame of a result that the request asks for: the one nearest to a strain or a time, or the one of an index.
/// Throws ServiceError: out_of_range for an index that there is not, and what ResultReader throws. REQUIRES: a strain
/// or time is finite.
v1::FieldFrame read_frame(const store::ResultReader& result, const v1::GetFrameRequest& request);

}  // namespace cellcrush::rpc
