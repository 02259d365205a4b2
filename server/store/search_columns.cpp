#include "store/search_columns.h"

namespace cellcrush::store {

std::string folded_title(const std::string& title) {
  std::string out = title;
  for (char& character : out) {
    if (character >= 'A' && character <= 'Z') character = static_cast<char>(character - 'A' + 'a');
  }
  return out;
}

void LabelInserter::insert(std::int64_t job, const google::protobuf::Map<std::string, std::string>& labels) {
  for (const auto& [key, value] : labels) insert_.bind_text(1, key).bind_text(2, value).bind(3, job).run();
}

}  // namespace cellcrush::store
