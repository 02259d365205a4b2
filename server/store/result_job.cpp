#include "store/result_job.h"

#include <google/protobuf/util/json_util.h>

#include <cstdint>
#include <sstream>
#include <string>

#include "store/result_layout.h"

namespace cellcrush::store {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

bool has_attribute(hid_t file, const std::string& name) { return H5Aexists(file, name.c_str()) > 0; }

std::string text_or_empty(hid_t file, const char* name) {
  return has_attribute(file, name) ? read_text_attribute(file, name) : "";
}

template <typename Parsed>
Parsed read_json(hid_t file, const char* name) {
  Parsed out;
  google::protobuf::util::JsonParseOptions options;
  options.ignore_unknown_fields = true;
  if (!google::protobuf::util::JsonStringToMessage(read_text_attribute(file, name), &out, options).ok())
    throw damaged_result(std::string("its ") + name + " cannot be read");
  return out;
}

// Sets each double of the message that has an attribute; returns whether one has.
bool read_numbers(hid_t file, const std::string& prefix, Message& message) {
  const auto& descriptor = *message.GetDescriptor();
  bool found = false;
  for (int i = 0; i < descriptor.field_count(); ++i) {
    const FieldDescriptor* field = descriptor.field(i);
    const std::string name = prefix + std::string(field->name());
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE || !has_attribute(file, name)) continue;
    message.GetReflection()->SetDouble(&message, field, read_number_attribute(file, name.c_str()));
    found = true;
  }
  return found;
}

// A part of the summary; absent if none of its numbers is there.
template <typename Part>
void read_part(hid_t file, const std::string& prefix, v1::Summary& summary, Part* (v1::Summary::*part)()) {
  if (Part numbers; read_numbers(file, prefix, numbers)) *(summary.*part)() = numbers;
}

// Lines of "KIND: message".
void read_warnings(hid_t file, v1::Summary& summary) {
  std::istringstream lines(text_or_empty(file, "warnings"));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find(": ");
    v1::Warning::Kind kind{};
    if (end == std::string::npos || !v1::Warning::Kind_Parse(line.substr(0, end), &kind)) continue;
    auto& warning = *summary.add_warnings();
    warning.set_kind(kind);
    warning.set_message(line.substr(end + 2));
  }
}

v1::Summary read_summary(hid_t file) {
  v1::Summary out;
  read_numbers(file, "", out);
  if (has_attribute(file, "step_count"))
    out.set_step_count(static_cast<std::int64_t>(read_number_attribute(file, "step_count")));
  if (has_attribute(file, "rigid_link_count"))
    out.set_rigid_link_count(static_cast<std::int64_t>(read_number_attribute(file, "rigid_link_count")));
  if (has_attribute(file, "start_overlap_count"))
    out.set_start_overlap_count(static_cast<std::int64_t>(read_number_attribute(file, "start_overlap_count")));
  if (has_attribute(file, "break_count"))
    out.set_break_count(static_cast<std::int64_t>(read_number_attribute(file, "break_count")));
  if (has_attribute(file, "theory_shock_error_relative"))
    out.set_shock_error_relative(read_number_attribute(file, "theory_shock_error_relative"));
  v1::Summary::CrushMode mode{};
  if (v1::Summary::CrushMode_Parse("CRUSH_MODE_" + text_or_empty(file, "crush_mode"), &mode)) out.set_crush_mode(mode);
  v1::Summary::OtherRise rise{};
  if (v1::Summary::OtherRise_Parse("OTHER_RISE_" + text_or_empty(file, "other_rise"), &rise)) out.set_other_rise(rise);
  read_part(file, "theory_", out, &v1::Summary::mutable_theory);
  read_part(file, "front_", out, &v1::Summary::mutable_front);
  read_part(file, "crush_forces_", out, &v1::Summary::mutable_crush_forces);
  read_part(file, "quasi_static_", out, &v1::Summary::mutable_quasi_static);
  read_part(file, "ledger_", out, &v1::Summary::mutable_ledger);
  read_part(file, "fibre_strain_", out, &v1::Summary::mutable_fibre_strain);
  if (has_attribute(file, "fibre_strain_wall"))
    out.mutable_fibre_strain()->set_wall(static_cast<std::int64_t>(read_number_attribute(file, "fibre_strain_wall")));
  read_part(file, "stage_", out, &v1::Summary::mutable_stage_times);
  read_warnings(file, out);
  return out;
}

}  // namespace

v1::Job read_job_of_result(hid_t file) {
  auto out = has_attribute(file, "job") ? read_json<v1::Job>(file, "job") : v1::Job();
  *out.mutable_case_() = read_json<v1::Case>(file, "case");
  out.set_title(out.case_().title());
  if (!out.has_summary()) *out.mutable_summary() = read_summary(file);
  const bool is_complete = read_number_attribute(file, "complete") != 0.0;
  const std::string failure = text_or_empty(file, "failure");
  out.set_state(is_complete ? v1::Job::SUCCEEDED : failure.empty() ? v1::Job::CANCELLED : v1::Job::FAILED);
  if (out.cause_message().empty()) out.set_cause_message(failure);
  return out;
}

}  // namespace cellcrush::store
