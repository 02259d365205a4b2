#pragma once

#include <string>

#include "store/job_filter.h"

namespace cellcrush::rpc {

/// Parses the filter of ListJobs, a subset of AIP-160: conditions joined by AND,
///   state = RUNNING            name of a state
///   owner = "NAME"             creator of the job
///   label.KEY = "value"        the job has that label; KEY may be quoted
///   title : "text"             the case's title contains the text, ignoring case
/// A value may stand without quotes when it has only letters, digits and . _ - / in it. Empty: all jobs. Throws
/// InvalidField, which names the position, counted from 1, and what is understood.
store::JobFilter parse_filter(const std::string& text);

/// Reads the order_by of ListJobs and returns whether the newest come first: "create_time desc" (the default) and "name
/// desc" give true, "create_time" and "name" false. Names are ordered by their numbers. Throws InvalidField.
bool parse_newest_first(const std::string& text);

}  // namespace cellcrush::rpc
