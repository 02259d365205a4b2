#pragma once

#include <string>

#include "connection/connection.h"
#include "terminal/output_file.h"

namespace cellcrush::client {

/// Downloads a job's result.h5 into a file that may have a part of it already. Continues a download that is cut off,
/// and compares all bytes with the server's sum. Throws CommandError: cut_off if the server stays away; the part then
/// stays for the next download.
void download_result(Connection& connection, const std::string& name, OutputFile& file);

}  // namespace cellcrush::client
