// Files as each system has them; what the standard library does everywhere is done by that.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "store/claim.h"

namespace rheocyte {

/// What distinguishes files from each other, and a file from what it was.
struct FileFacts {
  bool is_file = false, is_folder = false;
  std::uint64_t device = 0, number = 0, size = 0;
  std::int64_t content_changed_ns = 0, entry_changed_ns = 0;

  /// Two names of one file.
  bool is_same_as(const FileFacts& other) const { return device == other.device && number == other.number; }
};

enum class Links { follow, look_at };
/// Nothing if nothing is there.
std::optional<FileFacts> facts_of(const std::filesystem::path&, Links);

/// An open file, or the number of the error (errno).
struct OpenFile {
  Claim file;
  int failed = 0;
  FileFacts facts = {};
};

/// Never waits, as it would for a pipe to which no one writes.
OpenFile open_to_read(const std::filesystem::path&);
/// Makes the file or empties it, but not through a link.
OpenFile open_to_write(const std::filesystem::path&);
/// All of the content. 0, or errno; a quota or limit of the size is an error like a full disk.
int write_all(const Claim& file, std::string_view content);
/// A stream to a file that is made or emptied; nullptr if that fails.
std::FILE* open_stream(const std::filesystem::path&);

/// Another name of a file, of a link another name of the link.
void link_file(const std::filesystem::path& there, const std::filesystem::path& name);

/// A file or a folder. Returns 0 or errno.
int bring_to_disk(const std::filesystem::path&);

/// Whether this user can put files into a folder: 0, or errno.
int check_writable(const std::filesystem::path& folder);

/// What is written there is gone, and nothing can be read from there.
extern const char* const nowhere;

/// A text that this machine keeps until it is started again, and no other machine has.
std::string identity_of_machine();

}  // namespace rheocyte
