#include "command_line/store_commands.h"

#include <cstdio>
#include <string>

#include "log_format.h"
#include "store/backup.h"
#include "store/resource_name.h"
#include "store/result_import.h"
#include "store/verification.h"

namespace cellcrush {
namespace {

CLI::App* add_store_command(CLI::App& app, const char* name, const char* description, const char* of_folder,
                            std::filesystem::path& folder) {
  CLI::App* command = app.add_subcommand(name, description)->fallthrough();
  command->add_option("DIR", folder, of_folder)->required();
  return command;
}

// Prints notes and problems, one per line. Returns whether there are no problems.
bool print_findings(const store::Verification& found) {
  for (const auto& note : found.notes) std::printf("note: %s\n", printable(note).c_str());
  for (const auto& problem : found.problems) std::printf("problem: %s\n", printable(problem).c_str());
  return found.problems.empty();
}

/// "1 job, 0 sweeps, 2 results".
std::string counts_of(const store::Verification& found) {
  const auto counted = [](auto count, const char* name) {
    return std::to_string(count) + " " + name + (count == 1 ? "" : "s");
  };
  return counted(found.jobs, "job") + ", " + counted(found.sweeps, "sweep") + ", " + counted(found.results, "result");
}

}  // namespace

StoreCommands::StoreCommands(CLI::App& app)
    : backup_(add_store_command(app, "backup",
                                "Back up the data folder (--data) to a new folder; safe while a daemon uses it",
                                "Folder to create; if it exists, it must be empty", folder_)),
      verify_(add_store_command(
          app, "verify", "Check a backup or data folder and list all problems; exit code 1 if there are any, else 0",
          "Backup or data folder", folder_)),
      restore_(add_store_command(app, "restore", "Verify a backup and restore it to a new data folder (--data)",
                                 "Backup folder", folder_)),
      import_(app.add_subcommand("import",
                                 "Add an ended job for each result.h5 to the data folder (--data), which no daemon may "
                                 "be using, and print its name")
                  ->fallthrough()) {
  import_->add_option("FILE", files_, "A result.h5, or a folder of `cellcrush run` or `cellcrush fetch`")->required();
  import_->add_flag("--link", link_, "Refer to the files in place instead of copying them; they must stay there");
}

bool StoreCommands::given() const {
  return backup_->parsed() || verify_->parsed() || restore_->parsed() || import_->parsed();
}

int StoreCommands::run(const std::filesystem::path& data_folder) const {
  if (data_folder.empty() && !verify_->parsed()) {
    std::fprintf(stderr, "cellcrushd: neither XDG_DATA_HOME nor HOME is set. Give a data folder with --data.\n");
    return 2;
  }
  try {
    if (verify_->parsed()) return verify();
    if (import_->parsed()) return import(data_folder);
    return backup_->parsed() ? backup(data_folder) : restore(data_folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cellcrushd: %s\n", printable_lines(error.what()).c_str());
    return 1;
  }
}

int StoreCommands::backup(const std::filesystem::path& data_folder) const {
  const auto manifest = store::take_backup(data_folder, folder_);
  for (const auto& sentence : manifest.lost) std::fprintf(stderr, "cellcrushd: %s\n", printable(sentence).c_str());
  std::printf("%s contains the journal as of %s and %zu results\n", folder_.c_str(), manifest.created.c_str(),
              manifest.files.size() - 1);
  return 0;
}

int StoreCommands::verify() const {
  const auto found = store::verify_folder(folder_);
  if (!print_findings(found)) return 1;
  std::printf("%s is intact: %s\n", folder_.c_str(), counts_of(found).c_str());
  return 0;
}

int StoreCommands::restore(const std::filesystem::path& data_folder) const {
  const auto found = store::verify_folder(folder_);
  if (!found.is_backup) {
    std::fprintf(stderr, "cellcrushd: %s is not a backup. Give a folder made by `cellcrushd backup`.\n",
                 folder_.c_str());
    return 1;
  }
  if (!print_findings(found)) {
    std::fprintf(stderr, "cellcrushd: %s is damaged and was not restored. Use another backup.\n", folder_.c_str());
    return 1;
  }
  store::restore_backup(folder_, data_folder);
  std::printf("%s contains the backup of %s: %s\n", data_folder.c_str(), found.created.c_str(),
              counts_of(found).c_str());
  return 0;
}

int StoreCommands::import(const std::filesystem::path& data_folder) const {
  const auto jobs = store::import_results(data_folder, files_, link_ ? store::Import::link : store::Import::copy);
  for (std::size_t i = 0; i < jobs.size(); ++i)
    std::printf("%s  %s\n", store::name_of(jobs[i]).c_str(), files_[i].c_str());
  return 0;
}

}  // namespace cellcrush
