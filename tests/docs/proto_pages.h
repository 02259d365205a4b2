#pragma once

#include <string>

namespace cellcrush::docs {

/// proto/fields.md: every message and field of a case, from case.proto.
std::string make_fields_page();

/// core/fields/field_limits.inc: path, limits and unit of every number of a case that has limits, by path.
std::string make_field_limits();

/// proto/api.md: every service, rpc and message but those of a case, from the comments of the other files.
std::string make_api_page();

/// The page server/store/result_format.md with the table of the columns of /history made from sample.proto.
std::string with_history_columns(const std::string& page);

}  // namespace cellcrush::docs
