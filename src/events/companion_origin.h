// What every companion of a recording says about itself, and which file it may replace.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "measurement/companion_file.h"
#include "measurement/recording.h"

namespace rheocyte {

/// Name and version of this program.
std::string program();

/// Of userdef0 to userdef9 those that the recording does not use itself: for values for which the field's programs have
/// no name.
std::vector<std::string> free_features(const Recording& recording);

/// Says what stands in a feature of no name: `role` in one word, `meaning` in a sentence.
void describe_feature(CompanionFile& companion, const std::string& feature, const std::string& role,
                      const std::string& meaning);

/// Adds the log `rheocyte-COMMAND` (program, time, recording, and these lines) and the basin that leads from `folder`
/// to the recording, unless it is a text: where it is now, seen from there, and in that folder.
void add_origin(CompanionFile& companion, const std::string& command, const Recording& recording,
                const std::filesystem::path& folder, const std::vector<std::string>& lines);

/// Whether a file is a companion that this command has written: by its log, which no other recording has, those of
/// `rheocyte synth` neither. It is read in a process of its own, as it may be any file.
bool is_companion_of(const std::string& command, const std::filesystem::path& file);

/// UserError if something stands there that is no companion of this command.
void check_companion(const std::string& command, const std::filesystem::path& place);

/// UserError if a companion of another recording stands there: calls for single recordings of one name may write into
/// one folder.
void check_same_recording(const std::filesystem::path& place, const Recording& original);

}  // namespace rheocyte
