#pragma once

#include "cellcrush/v1/jobs_service.pb.h"
#include "store/result_reader.h"

namespace cellcrush::rpc {

/// The requested frame of a result: the nearest one to a strain or time, or the one with an index. Throws ServiceError:
/// out_of_range for an index that does not exist, and the errors of ResultReader. REQUIRES: a strain or time is finite.
v1::FieldFrame read_frame(const store::ResultReader& result, const v1::GetFrameRequest& request);

}  // namespace cellcrush::rpc
