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
  /// Another recording; the group /basin_events of the same file; cropped pictures there.
  enum class Kind { file, internal, cropped };
  Kind kind = Kind::file;
  std::string name;
  std::vector<std::string> paths;                    ///< of a file: the first that exists counts
  std::optional<std::vector<std::string>> features;  ///< the only ones it may give; all if there is no list
  std::string mapping;                               ///< feature with the event's number in the basin; empty: the same
};

/// Reads a definition (JSON). Nothing if it is broken, of a kind that needs a network, or of one that is not known.
std::optional<BasinDefinition> read_basin_definition(const std::string& json_text);

/// Why a basin whose definition is none of those above is not used, in a sentence that says what to do.
std::string why_basin_is_not_used(const std::string& json_text);

/// The definition of a basin of kind file, in lines for /basins; `mapping` as in BasinDefinition, or "same".
std::vector<std::string> file_basin_lines(const std::string& name, const std::vector<std::string>& paths,
                                          const std::string& mapping = "same");

/// The files that stand at the basin's paths (with "/" or "\\" between folders), relative ones seen from the folder of
/// the referring recording, or under the same names in that folder; in this order, at each path in turn.
std::vector<std::filesystem::path> basin_files(const BasinDefinition& basin,
                                               const std::filesystem::path& referring_file);

/// What the field's programs call a measurement: experiment:run identifier, else the MD5 digest of time, date and
/// setup:identifier joined by "_", written as a UUID. Nothing if one of the three is missing.
std::optional<std::string> measurement_identifier(const Metadata& metadata);

/// Whether two files may belong to one measurement: their identifiers are equal, or, with a mapping, the referring
/// one's starts with the basin's (programs that export a part of a recording append to it). True if one has none.
bool same_measurement(const Metadata& referring, const Metadata& basin, bool mapped);

}  // namespace rheocyte
