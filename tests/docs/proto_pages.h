#pragma once

#include <string>

namespace cellcrush::docs {

/// proto/fields.md: every message and field of a case, from the comments of case.proto.
std::string make_fields_page();

/// proto/api.md: every service, rpc and message but those of a case, from the comments of the other files.
std::string make_api_page();

}  // namespace cellcrush::docs
