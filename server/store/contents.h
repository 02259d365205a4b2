#pragma once

#include <string>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Makes the BLOBs in which the journal stores cases, sweeps and meshes (journal_format.md#contents). What is large in
/// them and may be the same in many rows goes into the table `contents`, once. A row lost there, or damaged, is written
/// again. Lives within a transaction. Throws ServiceError.
class ContentWriter {
 public:
  explicit ContentWriter(Database& database) : database_(database) {}

  std::string of_case(v1::Case submitted);
  std::string of_sweep(v1::Sweep sweep);
  std::string of_mesh(const v1::Mesh& mesh);

 private:
  /// The name of the content.
  const std::string& put(const std::string& bytes);

  Database& database_;
  std::string last_;  ///< the content put last, and its name: that of the next job of a sweep is the same
  std::string name_;
};

/// Reads such BLOBs. False for one that is no such message, or of which the content is missing or damaged. Keeps the
/// newest lattice: that of the next job of a sweep is the same. Not thread-safe. Throws ServiceError.
class ContentReader {
 public:
  explicit ContentReader(Database& database) : database_(database) {}

  bool read_case(const std::string& stored, v1::Case& out);
  bool read_sweep(const std::string& stored, v1::Sweep& out);
  bool read_mesh(const std::string& stored, v1::Mesh& out);

 private:
  template <class Message>
  bool read(const std::string& stored, Message& out, v1::Case& (*case_of)(Message&));

  Database& database_;
  std::string name_;
  std::string lattice_;
};

/// SQL for the size of the content that the row of `table` refers to, bytes; 0 for none.
std::string content_size_of(const std::string& table);

/// Adds the table to a journal without it. REQUIRES: a transaction is open. Throws ServiceError.
void add_contents(Database& database);

}  // namespace cellcrush::store
