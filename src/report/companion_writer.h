// The one writer of companions: columns of events under the names that the field's programs know, or under those of
// userdef0 to userdef9 that the recording leaves free, with their roles in the metadata.
#pragma once
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "measurement/companion_file.h"
#include "measurement/recording.h"
#include "report/column.h"

namespace rheocyte {

class CompanionWriter {
 public:
  /// What columns are called for which the field's programs have no name.
  enum class Naming {
    free_features,  ///< as many as there are: the columns of least rank have names first
    roles           ///< for this program alone
  };

  /// Makes the file. The recording must outlive the object. UserError.
  CompanionWriter(const std::filesystem::path& file, const Recording& recording);

  /// Declares the columns of which `write` takes blocks. One without a role is not there; one of rank 0 is the feature
  /// that its role names; others are described by role and sentence.
  void add(const std::vector<ColumnDescription>& columns, Naming naming = Naming::free_features);
  /// Declares a feature by its name; one that the recording stores is copied where that is possible.
  void add_feature(const std::string& name, bool is_stored = false);
  void add_metadata(const std::string& key, const std::string& text) { file_.add_user_metadata(key, text); }
  /// The log of the command with these lines, and the way back to the recording, seen from the folder.
  void add_origin(const std::string& command, const std::filesystem::path& folder,
                  const std::vector<std::string>& lines);

  /// Values of the events from `first` on, of each column. UserError, as of all below.
  void write(std::size_t first, std::span<const std::span<const double>> columns);
  /// And of a feature.
  void write(const std::string& feature, std::size_t first, std::span<const double> values) {
    file_.write(feature, first, values);
  }
  /// A companion of a text, to which no basin can lead, first gets all its other columns.
  void close();

  /// The roles for which the recording leaves no feature.
  const std::vector<std::string>& missing() const { return missing_; }

 private:
  void name(std::size_t column, const ColumnDescription& about, Naming naming);
  void write_other_columns();

  CompanionFile file_;
  const Recording& recording_;
  std::vector<std::string> free_;                           ///< the names that are left, in reverse order
  std::vector<std::pair<std::size_t, std::string>> names_;  ///< of the columns that have one
  std::set<std::string> features_;                          ///< all that are declared
  std::vector<std::string> missing_;
};

}  // namespace rheocyte
