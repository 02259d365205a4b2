#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "docs/page.h"
#include "docs/proto_comments.h"

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;
namespace pb = google::protobuf;

const fs::path kFolder = fs::path(CELLCRUSH_SOURCE_ROOT) / "proto";

// Compares a page with what its generator makes, or writes it where CELLCRUSH_WRITE_PAGES is set.
void hold(const fs::path& page, const std::string& made) {
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) std::ofstream(page, std::ios::binary) << made;
  EXPECT_TRUE(read_text(page) == made) << page << " is not what proto/cellcrush/v1 says. Rewrite it: "
                                       << "CELLCRUSH_WRITE_PAGES=1 build/ci/bin/proto_pages_test";
}

TEST(ProtoPages, FieldsAreThoseOfTheCase) { hold(kFolder / "fields.md", make_fields_page()); }

TEST(ProtoPages, TheLimitsOfTheSolverAreThoseOfTheCase) {
  hold(kFolder.parent_path() / "core/fields/field_limits.inc", make_field_limits());
}

TEST(ProtoPages, TheApiIsThatOfTheServices) { hold(kFolder / "api.md", make_api_page()); }

// Everything in a file that has no comment.
class Uncommented {
 public:
  void add_file(const pb::FileDescriptor& file) {
    for (int i = 0; i < file.message_type_count(); ++i) add_message(*file.message_type(i));
    for (int i = 0; i < file.enum_type_count(); ++i) add_enum(*file.enum_type(i));
    for (int i = 0; i < file.service_count(); ++i) {
      add(*file.service(i));
      for (int k = 0; k < file.service(i)->method_count(); ++k) add(*file.service(i)->method(k));
    }
  }

  [[nodiscard]] const std::string& names() const { return names_; }

 private:
  template <typename Declaration>
  void add(const Declaration& declaration) {
    if (comment_above(declaration).empty()) names_ += declaration.full_name() + "\n";
  }

  void add_message(const pb::Descriptor& type) {
    if (type.options().map_entry()) return;
    add(type);
    for (int i = 0; i < type.field_count(); ++i) add(*type.field(i));
    for (int i = 0; i < type.nested_type_count(); ++i) add_message(*type.nested_type(i));
    for (int i = 0; i < type.enum_type_count(); ++i) add_enum(*type.enum_type(i));
  }

  void add_enum(const pb::EnumDescriptor& type) {
    add(type);
    for (int i = 0; i < type.value_count(); ++i) {
      if (type.value(i)->number() != 0) add(*type.value(i));
    }
  }

  std::string names_;
};

TEST(ProtoComments, EveryDeclarationHasOne) {
  Uncommented uncommented;
  for (const char* name : {"admin_service", "case", "cases_service", "event", "field", "job", "jobs_service", "problem",
                           "sample", "sweep", "sweeps_service"})
    uncommented.add_file(find_proto(name));
  EXPECT_EQ(uncommented.names(), "");
}

}  // namespace
}  // namespace cellcrush::docs
