#include "slurm/file_link.h"

#include <filesystem>

namespace cellcrush::slurm {

void FileLink::fetch(const store::JobFolder& to) {
  copy_durably(folder_.files().order(), to.order());
  copy_run(folder_.files(), to);
}

void copy_run(const store::JobFolder& from, const store::JobFolder& to) {
  for (const auto& [own, copy] :
       {std::pair(from.reports(), to.reports()), std::pair(from.checkpoint(), to.checkpoint()),
        std::pair(from.previous_checkpoint(), to.previous_checkpoint())}) {
    if (std::filesystem::exists(own)) copy_durably(own, copy);
  }
}

}  // namespace cellcrush::slurm
