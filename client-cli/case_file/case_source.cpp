#include "case_file/case_source.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <iostream>
#include <utility>
#include <vector>

#include "case_file/set_field.h"
#include "command_error.h"
#include "connection/connection.h"
#include "drawing/compact_network.h"
#include "drawing/drawing.h"
#include "results/field_value.h"
#include "usage/suggestion.h"

namespace cellcrush::client {

namespace {

constexpr std::string_view kPresetPrefix = "preset:";
// Text is several times longer than the message it encodes; a longer one cannot fit into a message.
constexpr std::size_t kLargestText = 64 * 1024 * 1024;

// The file in the same folder whose name is nearest to a missing one; empty if none is near.
std::string find_nearest_file(const std::string& missing) {
  namespace fs = std::filesystem;
  const fs::path path(missing);
  const fs::path folder = path.parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (!entry->is_directory(error) && name != path.filename()) names.push_back(name.string());
  }
  std::sort(names.begin(), names.end());
  const std::string nearest = find_nearest(path.filename().string(), names);
  return nearest.empty() ? nearest : (folder / nearest).string();
}

std::string read_stream(std::istream& stream, const std::string& name) {
  std::string text;
  std::vector<char> buffer(1 << 16);
  while (stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || stream.gcount() > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargestText) {
      refuse(name +
             ": longer than 64 MiB of text; the limit of a case is 4 MiB as a "
             "message. Make the case smaller");
    }
  }
  return text;
}

std::string read_all(const std::string& file) {
  if (file == "-") return read_stream(std::cin, "stdin");
  std::ifstream stream;
  if (const std::string failure = open_failure(file, stream); !failure.empty())
    refuse(failure + (failure.ends_with('?') ? " Give" : "; give") +
           " a case file or preset:NAME (`cellcrush presets` lists them)");
  return read_stream(stream, file);
}

v1::Case read_file(const std::string& file) {
  if (drawing::names_drawing(file)) {
    refuse(fmt::format(
        "{0}: is a drawing. Give it with --lattice to a case, such as preset:hexagon-small --lattice {0}.", file));
  }
  const std::string text = read_all(file);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const bool json = file.ends_with(".json") || (begin != std::string::npos && text[begin] == '{');
  const std::string name = file == "-" ? "stdin" : file;
  if (text.find('\0') != std::string::npos) {
    refuse(name +
           ": not a text file; a case is protobuf text or JSON, such as the output "
           "of `cellcrush show preset:type-i`");
  }
  return json ? parse_json_case(text, name) : parse_text_case(text, name);
}

// Sets the fields, and shows a person what was read; without a terminal only where it is not what was typed.
void assign(v1::Case& target, const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) {
    set_field(target, assignment);
    const std::string path = assignment.substr(0, assignment.find('='));
    const std::string value = field_value_text(target, path);
    if (value.empty() || (isatty(STDERR_FILENO) == 0 && assignment.find(',') == std::string::npos)) continue;
    const std::string unit = words_of(path).unit;
    fmt::print(stderr, "{} = {}{}{}\n", path, value, unit.empty() ? "" : " ", unit);
  }
}

// Changes the case as the options say.
void change(v1::Case& target, const CaseOptions& options, v1::ImportReport* report) {
  if (!options.lattice.files.empty()) {
    const v1::ImportLatticeResponse drawn = read_drawn_lattice(options.lattice);
    if (report != nullptr) {
      *report = drawn.report();
    } else {
      for (const std::string& line : drawn.report().lines()) fmt::print(stderr, "{}\n", line);
    }
    replace_lattice(drawn.network(), target);
  } else if (options.lattice.says_how()) {
    refuse(
        "--unit, --thickness, --tolerance, --bond and --keep-crossings say how a drawing is read. Give it with "
        "--lattice.");
  }
  assign(target, options.assignments);
  // Only where every number stays the same.
  if (target.lattice().has_network() && target.lattice().network().ByteSizeLong() > drawing::kLargestLists)
    drawing::make_compact(*target.mutable_lattice()->mutable_network(), drawing::Rounding::none);
}

}  // namespace

std::string open_failure(const std::string& file, std::ifstream& stream) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) return file + ": is a folder";
  stream.open(file, std::ios::binary);
  if (stream) return {};
  const int error = errno;
  const std::string message = fmt::format("{}: cannot be read: {}", file, std::strerror(error));
  return error == ENOENT ? with_suggestion(message, find_nearest_file(file)) : message;
}

std::string read_bytes(const std::string& file) {
  std::ifstream stream;
  if (const std::string failure = open_failure(file, stream); !failure.empty()) refuse(failure);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string preset_name(const std::string& source) {
  return source.starts_with(kPresetPrefix) ? source.substr(kPresetPrefix.size()) : std::string();
}

std::optional<v1::Case> read_own_case(const CaseOptions& options) {
  if (options.source.starts_with(kPresetPrefix)) return std::nullopt;
  v1::Case result = read_file(options.source);
  change(result, options, nullptr);
  return result;
}

v1::Case read_case(const CaseOptions& options, Connection& connection, v1::ImportReport* report) {
  v1::Case result;
  if (preset_name(options.source).empty()) {
    result = read_file(options.source);
    change(result, options, report);
    return result;
  }
  v1::GetPresetRequest request;
  request.set_name(preset_name(options.source));
  try {
    result = connection.call(connection.cases(), &v1::Cases::Stub::GetPreset, request).case_();
  } catch (const CommandError& error) {
    // A preset that does not exist is an invalid CASE rather than a missing resource.
    if (error.code() != ExitCode::not_found) throw;
    refuse(error.message());
  }
  change(result, options, report);
  return result;
}

}  // namespace cellcrush::client
