#include "table/table_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <iterator>
#include <system_error>

#include "case/user_error.h"
#include "case/write_case.h"
#include "numeric/fingerprint.h"
#include "store/build_info.h"
#include "store/read_file.h"
#include "store/whole_file.h"
#include "table/square_branches.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr const char* work = "branches";
constexpr const char* mark = "begun-by.txt";
constexpr const char* beginning = "begun-by.claim";  ///< whoever holds it writes spec and mark

std::string reason_of(int number) { return std::generic_category().message(number); }

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", path.string(), reason));
}

std::string content_of(const fs::path& path) {
  constexpr std::size_t enough = std::size_t{1} << 30U;
  return first_bytes(path, enough).value_or("");
}

// Nothing if another process holds it, unless the operation waits for that one.
Claim claim_on(const fs::path& path, int operation) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse(path, fmt::format("cannot be made ({}).", reason_of(errno)));
  if (::flock(descriptor, operation) == 0) return Claim(descriptor);
  const int reason = errno;
  ::close(descriptor);
  if (reason != EWOULDBLOCK)
    refuse(path, fmt::format("cannot be locked ({}); put the table on a file system that knows locks, with -o.",
                             reason_of(reason)));
  return {};
}

std::string mark_of_earlier_builds(const std::string& spec_hash) {
  return fmt::format("rheocyte {} table, spec {}\n", version, spec_hash);
}

bool is_cell_of(const BranchPlace& place, const SampledBranch& branch) {
  return std::abs(branch.radius_um - place.radius_um) < 1e-9 * place.radius_um &&
         branch.cortex_share == place.cortex_share && branch.tension_ratio == place.tension_ratio &&
         branch.axial_ratio == place.axial_ratio;
}

void write_whole(const fs::path& path, std::string_view content) {
  if (const int failed = write_whole_file(path, content))
    refuse(path, fmt::format("cannot be written ({}); what is finished is kept, start again with the same command.",
                             reason_of(failed)));
}

}  // namespace

TableFolder::TableFolder(const fs::path& folder, const TableSpec& spec)
    : folder_(folder),
      spec_(spec),
      hash_(spec_hash(spec)),
      places_(sweep_places(spec)),
      plan_(spec, [this](const BranchTask& task) -> RadiusPlan::Branch {
        if (!has(task.place, task.held)) return nullptr;
        return std::make_shared<SampledBranch>(read(task.place, task.held));
      }) {
  mark_ = fmt::format("rheocyte {} table, spec {}, branches {}\n", version, hash_, fingerprint(layout()));
  begin();
}

// Two programs that agree on this want the same files with the same cells and can read each other's. Six digits: the
// last bits of a radius depend on the processor for which a program was built.
std::string TableFolder::layout() const {
  std::string text = branch_record_format() + "\n";
  for (int i = 0; i < branches(); ++i) {
    text += fmt::format("{} {:.6g} {:.6g} {:.6g}{}", record(i, false).filename().string(), place(i).radius_um,
                        place(i).cortex_share, place(i).tension_ratio, spec_.wants_held() ? " held" : "");
    text += spec_.is_elongated() ? fmt::format(" axial {:.6g}\n", place(i).axial_ratio) : "\n";
  }
  return text;
}

bool TableFolder::is_begun() const {
  std::error_code error;
  if (!fs::exists(folder_ / mark, error)) return false;
  const std::string found = content_of(folder_ / mark);
  if (found == mark_ || found == mark_of_earlier_builds(hash_)) return true;
  refuse(folder_, fmt::format("holds a table that was begun as \"{}\", not as \"{}\"; give another folder with -o, or "
                              "the spec and program of the first start.",
                              found.substr(0, found.find('\n')), mark_.substr(0, mark_.size() - 1)));
}

void TableFolder::begin() const {
  if (is_begun()) return;
  std::error_code error, ignored;
  fs::create_directories(folder_, error);
  if (error && !fs::exists(folder_, ignored)) refuse(folder_, fmt::format("cannot be made ({}).", error.message()));
  const bool has_files = !fs::is_directory(folder_, ignored) || !fs::is_empty(folder_, ignored);
  // With the claim beside them they are ours: of a process that begins at this moment, or was lost on the way.
  if (has_files && !fs::exists(folder_ / beginning, ignored))
    refuse(folder_, "holds other files; give a new or empty folder with -o.");
  const Claim alone = claim_on(folder_ / beginning, LOCK_EX);
  if (is_begun()) return;
  fs::create_directories(folder_ / work, error);
  if (error) refuse(folder_, fmt::format("cannot be made ({}).", error.message()));
  write_whole(folder_ / "spec.toml", to_toml(spec_));
  write_whole(folder_ / mark, mark_);
}

void TableFolder::take_over() const {
  std::string first;
  int unusable = 0;
  for (int i = 0; i < branches(); ++i)
    for (const bool held : {false, true}) {
      try {
        if (has(i, held)) read(i, held);
      } catch (const UserError& error) {
        if (unusable++ == 0) first = error.what();
      }
    }
  if (unusable > 1) first += fmt::format(" There are {} of that kind in this folder.", unusable);
  if (unusable > 0) throw UserError(first);
  if (content_of(folder_ / mark) != mark_) write_whole(folder_ / mark, mark_);
}

fs::path TableFolder::record(int i, bool held) const {
  return folder_ / work /
         fmt::format("{}-{:04}{}.cbor", spec_.is_combined() ? "branch" : "radius", i, held ? "-held" : "");
}

bool TableFolder::has(int i, bool held) const {
  std::error_code error;
  return fs::exists(record(i, held), error);
}

bool TableFolder::update_plan() const {
  const auto is_there = [this](const BranchTask& task) { return has(task.place, task.held); };
  const auto& missing = plan_.missing();
  return missing.empty() || std::ranges::any_of(missing, is_there) ? plan_.update() : false;
}

int TableFolder::done() const {
  const std::lock_guard lock(plan_mutex_);
  if (update_plan()) return branches();
  int count = 0;
  for (int i = 0; i < branches(); ++i)
    count += plan_.branch({i, false}) && (!spec_.wants_held() || plan_.branch({i, true}));
  return std::min(count, branches() - 1);
}

std::vector<BranchTask> TableFolder::missing() const {
  const std::lock_guard lock(plan_mutex_);
  update_plan();
  return plan_.missing();
}

Claim TableFolder::claim(int i) const {
  return claim_on(folder_ / work / fmt::format("branch-{:04}.claim", i), LOCK_EX | LOCK_NB);
}

void TableFolder::keep(int i, const SampledBranch& branch, bool held) const {
  write_whole(record(i, held), to_bytes(branch, hash_));
}

SampledBranch TableFolder::read(int i, bool held) const {
  SampledBranch branch = branch_from_bytes(content_of(record(i, held)), hash_, record(i, held).string());
  if (!branch.empty() && !is_cell_of(place(i), branch))
    refuse(record(i, held), "this record holds another cell of the sweep; delete it, and it is computed again.");
  return branch;
}

SampledBranch TableFolder::branch(int i, bool held) const {
  const std::lock_guard lock(plan_mutex_);
  const auto branch = plan_.branch({i, held});
  assert(branch);
  return *branch;
}

std::vector<SampledBranch> TableFolder::read_all() const {
  if (const auto lacking = missing(); !lacking.empty())
    return read(lacking.front().place, lacking.front().held), std::vector<SampledBranch>();
  std::vector<SampledBranch> all;
  for (int i = 0; i < branches(); ++i) {
    all.push_back(branch(i, false));
    if (!spec_.wants_held()) continue;
    SampledBranch held = branch(i, true);
    if (!held.empty() || has(i, true)) all.push_back(std::move(held));
  }
  return all;
}

bool TableFolder::lacks_tube() const {
  std::error_code error;
  return spec_.tube_table && !fs::exists(folder_ / tube_table_file, error);
}

std::optional<GridContent> TableFolder::tube() const {
  if (!spec_.tube_table) return {};
  const fs::path file = folder_ / tube_table_file;
  return grid_from_bytes(content_of(file), file.string());
}

std::vector<SampledBranch> TableFolder::all_branches() const {
  auto branches = read_all();
  if (!spec_.is_square()) return branches;
  const auto tube_table = tube();
  const GridContent* reference = tube_table ? &*tube_table : nullptr;
  const auto is_own = [](const SampledBranch& branch) { return branch.bending_kBT == 0; };
  const auto first_held = std::stable_partition(branches.begin(), branches.end(), is_own);
  auto all = square_branches(spec_, {branches.begin(), first_held}, reference);
  if (can_lie_between({first_held, branches.end()}))
    std::ranges::move(square_branches(spec_, {first_held, branches.end()}, reference), std::back_inserter(all));
  return all;
}

void TableFolder::tidy() const {
  std::error_code error;
  for (const auto& place : {folder_ / work, folder_})
    for (const auto& entry : fs::directory_iterator(place, error))
      if (entry.path().extension() == ".claim" || place_of(entry.path()) != entry.path())
        fs::remove(entry.path(), error);
}

void TableFolder::publish(const std::string& name, std::string_view content) const {
  write_whole(folder_ / name, content);
}

}  // namespace rheocyte
