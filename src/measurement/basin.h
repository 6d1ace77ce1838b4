// Basins: how a recording says that features of its events lie in another place.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measurement/metadata.h"

namespace rheocyte {

/// One definition below /basins, of the kinds that are read here.
struct BasinDefinition {
  enum class Kind { file, internal };  ///< another recording, or the group /basin_events of the same file
  Kind kind = Kind::file;
  std::string name;
  std::vector<std::string> paths;                    ///< of a file: the first that exists counts
  std::optional<std::vector<std::string>> features;  ///< the only ones it may give; all if there is no list
  std::string mapping;                               ///< feature with the event's number in the basin; empty: the same
};

/// Reads a definition (JSON). Nothing if it is broken or of a kind that needs a network.
std::optional<BasinDefinition> read_basin_definition(const std::string& json_text);

/// Name and format of a basin on a network; nothing if the definition is another one.
std::optional<std::string> name_of_remote_basin(const std::string& json_text);

/// The definition of a basin of kind file with equal numbers of events, in lines for /basins.
std::vector<std::string> file_basin_lines(const std::string& name, const std::vector<std::string>& paths);

/// The first of the paths that is a file, relative ones seen from the folder of the referring recording.
std::optional<std::filesystem::path> find_basin_file(const BasinDefinition& basin,
                                                     const std::filesystem::path& referring_file);

/// Whether two files belong to one measurement: equal run identifiers, or equal time, date and setup identifier.
/// With a mapping, it is enough that the referring one's run identifier starts with the basin's.
bool same_measurement(const Metadata& referring, const Metadata& basin, bool mapped);

}  // namespace rheocyte
