// One text file of a result: whole or not at all, and never in the place of a file that is not ours.
#pragma once
#include <filesystem>
#include <string_view>

namespace rheocyte {

/// What becomes of a file in the requested place that is not ours.
enum class Foreign {
  keep,                ///< the command has no way to replace it
  keep_unless_forced,  ///< the sentence names --force
  replace
};
/// Of a command with --force.
inline Foreign foreign(bool force) { return force ? Foreign::replace : Foreign::keep_unless_forced; }

/// Whether it is a file that begins with `mark`.
bool is_own_file(const std::filesystem::path&, std::string_view mark);

/// Whether it is a picture that this program has drawn: its metadata name it.
bool is_own_picture(const std::filesystem::path&);

/// UserError if a file, a folder or something else stands in the requested place that is not ours to replace: that does
/// not begin with `mark`, or as `foreign` says.
void check_replaceable(const std::filesystem::path&, std::string_view mark, Foreign foreign);

/// The same of a picture: what a user may do instead follows in words.
void check_replaceable_picture(const std::filesystem::path&, std::string_view way_out);

/// Writes `content` beside the wanted place and renames it; makes the parent folders. An existing file is replaced if
/// it begins with `mark`, the words with which all files of this kind from rheocyte begin, or as `foreign` says.
/// UserError, and an older file is left as it was.
void replace_own_file(const std::filesystem::path&, std::string_view content, std::string_view mark, Foreign foreign);

}  // namespace rheocyte
