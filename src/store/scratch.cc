#include "store/scratch.h"

#include <fmt/format.h>

#include <cerrno>
#include <mutex>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "case/to_path.h"
#include "numeric/fingerprint.h"
#include "store/system_files.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view infix = ".rheocyte-";
constexpr std::size_t machine_digits = 12, random_digits = 12;
constexpr int max_number_of_tries = 100;

bool is_first_call_for(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> known;
  const std::lock_guard lock(mutex);
  return known.insert(folder).second;
}

/// This machine since it was started, in machine_digits. A lock may hold on one machine alone (NFS with local_lock,
/// Lustre with localflock), so that a file of another one seems to be no one's.
const std::string& this_machine() {
  static const std::string digits = fingerprint(identity_of_machine()).substr(0, machine_digits);
  return digits;
}

bool is_digits(std::string_view text) { return text.find_first_not_of("0123456789abcdef") == std::string_view::npos; }

fs::path folder_of(const fs::path& wanted) { return wanted.has_parent_path() ? wanted.parent_path() : "."; }

// EWOULDBLOCK: another process has taken it for a left-over in the moment between its making and its claim.
Scratch new_scratch(const fs::path& wanted, Claiming (*make)(const fs::path&)) {
  for (int i = 0; i < max_number_of_tries; ++i) {
    const fs::path path = scratch_beside(wanted);
    Claiming made = make(path);
    if (!made.failed) return {path, std::move(made.claim)};
    if (made.failed != EEXIST && made.failed != EWOULDBLOCK) return {{}, {}, made.failed};
  }
  return {{}, {}, EEXIST};
}

}  // namespace

fs::path scratch_beside(const fs::path& wanted) {
  std::random_device random;  // the system's, not a series from a seed
  const auto number = std::uint64_t{random()} << 32U | random();
  return wanted.parent_path() / to_path(fmt::format(".{:.200}{}{}{:0{}x}", wanted.filename().string(), infix,
                                                    this_machine(), number & 0xffff'ffff'ffffU, random_digits));
}

fs::path place_of(const fs::path& scratch) {
  const std::string name = scratch.filename().string();
  const auto end = name.rfind(infix);
  if (!name.starts_with('.') || end == std::string::npos || end == 0) return scratch;
  const std::string_view digits = std::string_view(name).substr(end + infix.size());
  // Versions up to 0.2 wrote the random digits alone.
  const bool is_hidden =
      is_digits(digits) && (digits.size() == random_digits || digits.size() == machine_digits + random_digits);
  return is_hidden ? scratch.parent_path() / to_path(name.substr(1, end - 1)) : scratch;
}

void remove_left_over_files(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (place_of(entry.path()) == entry.path() || !entry.is_regular_file(error) || entry.is_symlink(error)) continue;
    const std::string name = entry.path().filename().string();
    if (!name.substr(name.rfind(infix) + infix.size()).starts_with(this_machine())) continue;
    if (const Claim mine = claim_on(entry.path())) fs::remove(entry.path(), error);
  }
}

Scratch new_scratch_file(const fs::path& wanted) {
  if (is_first_call_for(folder_of(wanted))) remove_left_over_files(folder_of(wanted));
  return new_scratch(wanted, make_claimed_file);
}

Scratch new_scratch_folder(const fs::path& wanted) { return new_scratch(wanted, make_claimed_folder); }

void remove_scratch(const Scratch& scratch) {
  std::error_code ignored;
  if (!scratch.path.empty()) fs::remove_all(scratch.path, ignored);
}

std::vector<Scratch> left_over_folders(const fs::path& place) {
  std::vector<Scratch> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_of(place), error)) {
    const bool hidden = place_of(entry.path()) != entry.path();
    if (!hidden || place_of(entry.path()).filename() != place.filename() || entry.is_symlink(error) ||
        !entry.is_directory(error))
      continue;
    if (Claim mine = claim_on(entry.path())) found.push_back({entry.path(), std::move(mine)});
  }
  return found;
}

}  // namespace rheocyte
