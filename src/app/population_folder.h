// The folder of the results of `rheocyte population`, in which files of others may stand, too.
#pragma once
#include <optional>
#include <vector>

#include "experiment/population_recordings.h"
#include "store/python_package.h"
#include "store/result_files.h"

namespace rheocyte {

class PopulationFolder {
 public:
  /// UserError if a recording of this call, or a file of others, stands where one of the results may go.
  PopulationFolder(const PopulationOptions& options, const std::vector<PopulationCondition>& conditions,
                   bool with_pictures);

  /// Puts all files in their places, or none of them. What an earlier call has written there and this one has not,
  /// goes. UserError.
  void write(const PopulationReport& report);

 private:
  void check(const std::filesystem::path& place) const;
  void add_events(const RecordingReport& recording, const PopulationReport& report);
  void add_pictures(const std::string& json);
  void remove_earlier() const;

  const PopulationOptions& options_;
  std::vector<std::filesystem::path> recordings_;
  std::optional<Drawing> drawing_;  ///< loads while the recordings are read
  ResultFiles files_;
  std::vector<std::filesystem::path> written_;
};

}  // namespace rheocyte
