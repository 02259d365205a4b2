#pragma once

#include <google/protobuf/map.h>

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace cellcrush::client {

using Labels = google::protobuf::Map<std::string, std::string>;

/// Adds --label, which may be repeated, to a command.
void add_label_option(CLI::App& command, std::vector<std::string>& labels);

/// Parses "KEY=VALUE" texts as labels. Throws CommandError (refused) for another form.
Labels parse_labels(const std::vector<std::string>& texts);

}  // namespace cellcrush::client
