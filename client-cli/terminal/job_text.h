#pragma once

#include <string>

#include "cellcrush/v1/job.pb.h"
#include "terminal/table.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// Outcome or state of a job: a heading, then for a SUCCEEDED job its plateau stresses with theory, energy and contact;
/// for a FAILED one the cause, the message and the remedy.
std::string outcome_text(const v1::Job& job, int width = terminal_width());

/// A full description of a job.
std::string description_text(const v1::Job& job, int width = terminal_width());

/// Labels in the order of their keys: "batch=7, who=me".
std::string labels_text(const google::protobuf::Map<std::string, std::string>& labels);

/// Adds the lines of a note, if there is one, as rows of a heading and a text.
void add_note_rows(Table& table, const std::string& note);

/// The first line of a note, for a cell of a list.
std::string short_note_text(const std::string& note);

/// "2026-03-01T12:00:00Z".
std::string time_text(const google::protobuf::Timestamp& time);

/// Name of an executor other than the server's machine; empty for that machine, and from servers without executors.
inline std::string executor_text(const std::string& executor) { return executor == "local" ? "" : executor; }

}  // namespace cellcrush::client
