#include <fmt/format.h>
#include <google/protobuf/struct.pb.h>

#include <algorithm>

#include "commands/commands.h"
#include "help/case_manual.h"
#include "terminal/table.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

// One line per name and text, with the texts aligned.
std::string two_columns(const NamedTexts& entries, int width) {
  Table table({Table::Align::left, Table::Align::left});
  for (const auto& [name, text] : entries) table.add({name, text});
  return table.text(2, width);
}

std::string manual_text(const FieldManual& manual, int width) {
  std::string text = manual.path.empty() ? "" : manual.path + "\n";
  NamedTexts facts = {{"Type", manual.type}};
  if (!manual.unit.empty()) facts.emplace_back("Unit", manual.unit);
  if (manual.unit.empty() && manual.type == "double") facts.emplace_back("Unit", "none (dimensionless)");
  if (!manual.default_value.empty()) facts.emplace_back("Default", manual.default_value);
  if (!manual.limits.empty()) facts.emplace_back("Limits", manual.limits);
  text += two_columns(facts, width) + "\n" + wrap_text(manual.comment, width) + "\n";
  if (!manual.values.empty()) text += "\nValues:\n" + two_columns(manual.values, width);
  if (!manual.fields.empty()) text += "\nFields:\n" + two_columns(manual.fields, width);
  return text;
}

google::protobuf::Struct manual_json(const FieldManual& manual) {
  google::protobuf::Struct json;
  auto& members = *json.mutable_fields();
  const auto put = [&members](const char* name, const std::string& text) { members[name].set_string_value(text); };
  const auto put_all = [&members](const char* name, const char* text_name, const NamedTexts& entries) {
    auto& list = *members[name].mutable_list_value();
    for (const auto& [entry, text] : entries) {
      auto& fields = *list.add_values()->mutable_struct_value()->mutable_fields();
      fields["name"].set_string_value(entry);
      fields[text_name].set_string_value(text);
    }
  };
  put("path", manual.path);
  put("type", manual.type);
  put("unit", manual.unit);
  put("default", manual.default_value);
  put("limits", manual.limits);
  put("comment", manual.comment);
  put_all("values", "comment", manual.values);
  put_all("fields", "summary", manual.fields);
  return json;
}

ExitCode run_explain(const Session& session, const std::string& path) {
  constexpr int kWidestText = 100;
  const FieldManual manual = find_field_manual(path);
  const int width = std::min(terminal_width(), kWidestText);
  session.json ? print_json(manual_json(manual)) : fmt::print("{}", manual_text(manual, width));
  return ExitCode::done;
}

}  // namespace

void add_explain_command(CLI::App& app, Session& session) {
  const auto path = std::make_shared<std::string>();
  CLI::App* command = add_command(app, session, kCaseCommands, "explain",
                                  "Describe a field of a case: its type, unit, default and limits",
                                  [&session, path] { return run_explain(session, *path); });
  command->add_option("PATH", *path, "Field path, such as loading.speed_m_per_s (default: the whole case)");
  add_examples(*command, {"cellcrush explain", "cellcrush explain loading", "cellcrush explain loading.ramp_strain"});
}

}  // namespace cellcrush::client
