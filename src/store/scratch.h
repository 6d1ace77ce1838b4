// Hidden names beside the place of a result, under which it is written until it is whole.
#pragma once
#include <filesystem>
#include <vector>

#include "store/claim.h"

namespace rheocyte {

/// A hidden name in the same folder that no one can foresee: ".NAME.rheocyte-9b3c1d70ff241f0c97aa52de", the machine
/// first.
std::filesystem::path scratch_beside(const std::filesystem::path& wanted);
/// The place for which a hidden name was made; of another path the path itself.
std::filesystem::path place_of(const std::filesystem::path& scratch);

/// A file or folder under a hidden name. Its claim says to other processes that somebody still works on it.
struct Scratch {
  std::filesystem::path path;
  Claim claim;
  int failed = 0;  ///< the number of the error (errno) if it could not be made
};

/// A new empty file or folder; never through a link, and never what is there already. The first call for a folder also
/// removes left over files in it.
Scratch new_scratch_file(const std::filesystem::path& wanted);
Scratch new_scratch_folder(const std::filesystem::path& wanted);

/// Removes it with all that it holds.
void remove_scratch(const Scratch&);

/// The files of hidden names in a folder that killed processes of this machine have left since it was started. Those of
/// other machines may be in use.
void remove_left_over_files(const std::filesystem::path& folder);

/// The hidden folders of a place on which no one works any more, each with a claim.
std::vector<Scratch> left_over_folders(const std::filesystem::path& place);

}  // namespace rheocyte
