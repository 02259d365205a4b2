#pragma once

#include "cellcrush/v1/job.pb.h"
#include "store/hdf5.h"

namespace cellcrush::store {

/// The ended job of a result: case, title, state and summary, with the other fields of the attribute `job`. Results of
/// earlier versions lack that attribute. Their summary is read from the attributes of write_summary_attributes: the
/// cause of a failure, the steps of warnings and theory.densification_strain stay empty. Throws ServiceError: data_loss
/// for attributes that cannot be read.
v1::Job read_job_of_result(hid_t file);

}  // namespace cellcrush::store
