// Files that a user has put into the folder of a result.
#pragma once
#include <filesystem>
#include <span>
#include <string_view>

namespace rheocyte {

using OwnNames = std::span<const std::string_view>;

/// Whether the folder holds anything of another name than `own`.
bool has_user_files(const std::filesystem::path& folder, OwnNames own);

/// Makes them appear in another folder, too, of the same file system. What cannot be linked is left out.
void link_user_files(const std::filesystem::path& from, const std::filesystem::path& to, OwnNames own);

/// What becomes of different files of one name.
enum class Twice { moved_replaces, both_stay };

/// Moves them to another folder; those that stand there already, linked before, stay where they are. Whether none of
/// them is now in the first folder alone.
bool move_user_files(const std::filesystem::path& from, const std::filesystem::path& to, OwnNames own, Twice twice);

}  // namespace rheocyte
