#pragma once

#include <string>
#include <vector>

namespace cellcrush::docs {

/// A line with `#` for what differs between two runs of the same command: times, rates, memory, dates, ports, ids of
/// processes and revisions, each recognised by its unit or its place. All other figures stay.
std::string without_volatile(const std::string& line);

/// The lines that a page should show of an output. `shown` are the lines that it shows; "..." among them stands for any
/// lines left out. Each other line becomes the line of the output that it is most like; lines that differ only in
/// volatile values stay, and so do the "...". Lines of the output between two shown ones, and after the last one, are
/// added. Shown lines that are like none of the output go.
std::vector<std::string> show_again(const std::vector<std::string>& shown, const std::string& output);

}  // namespace cellcrush::docs
