#include "table/table_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <system_error>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "numeric/fingerprint.h"
#include "store/build_info.h"
#include "store/read_file.h"
#include "table/square_branches.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

std::string mark_of_earlier_builds(const std::string& spec_hash) {
  return fmt::format("rheocyte {} table, spec {}\n", version, spec_hash);
}

bool is_cell_of(const SweepPoint& place, const SampledBranch& branch) {
  return std::abs(branch.radius_um - place.radius_um) < 1e-9 * place.radius_um &&
         branch.cortex_fraction == place.cortex_fraction && branch.tension_ratio == place.tension_ratio &&
         branch.axial_ratio == place.axial_ratio;
}

}  // namespace

TableFolder::TableFolder(const fs::path& folder, const TableSpec& spec)
    : spec_(spec),
      hash_(spec_hash(spec)),
      places_(sweep_places(spec)),
      folder_(folder, wanted()),
      plan_(spec, [this](const BranchTask& task) -> RadiusPlan::Branch {
        if (!has(task.place, task.regularised)) return nullptr;
        return std::make_shared<SampledBranch>(read(task.place, task.regularised));
      }) {}

WantedWork TableFolder::wanted() const {
  return {to_toml(spec_),
          fmt::format("rheocyte {} table, spec {}, branches {}\n", version, hash_, fingerprint(layout())),
          mark_of_earlier_builds(hash_), "branches"};
}

// Two programs that agree on this want the same files with the same cells and can read each other's. Six digits: the
// last bits of a radius depend on the processor for which a program was built.
std::string TableFolder::layout() const {
  std::string text = branch_record_format() + "\n";
  for (int i = 0; i < branches(); ++i) {
    text += fmt::format("{} {:.6g} {:.6g} {:.6g}{}", record(i, false), place(i).radius_um, place(i).cortex_fraction,
                        place(i).tension_ratio, spec_.wants_regularised() ? " held" : "");
    text += spec_.is_elongated() ? fmt::format(" axial {:.6g}\n", place(i).axial_ratio) : "\n";
  }
  return text;
}

void TableFolder::take_over() const {
  std::string first;
  int unusable = 0;
  for (int i = 0; i < branches(); ++i)
    for (const bool regularised : {false, true}) {
      try {
        if (has(i, regularised)) read(i, regularised);
      } catch (const UserError& error) {
        if (unusable++ == 0) first = error.what();
      }
    }
  if (unusable > 1) first += fmt::format(" There are {} of that kind in this folder.", unusable);
  if (unusable > 0) throw UserError(first);
  folder_.take_over();
}

std::string TableFolder::record(int i, bool regularised) const {
  return fmt::format("{}-{:04}{}.cbor", spec_.is_combined() ? "branch" : "radius", i, regularised ? "-held" : "");
}

bool TableFolder::has(int i, bool regularised) const { return folder_.has(record(i, regularised)); }

bool TableFolder::update_plan() const {
  const auto is_there = [this](const BranchTask& task) { return has(task.place, task.regularised); };
  const auto& missing = plan_.missing();
  return missing.empty() || std::ranges::any_of(missing, is_there) ? plan_.update() : false;
}

int TableFolder::done() const {
  const std::lock_guard lock(plan_mutex_);
  if (update_plan()) return branches();
  int count = 0;
  for (int i = 0; i < branches(); ++i)
    count += plan_.branch({i, false}) && (!spec_.wants_regularised() || plan_.branch({i, true}));
  return std::min(count, branches() - 1);
}

std::vector<BranchTask> TableFolder::missing() const {
  const std::lock_guard lock(plan_mutex_);
  update_plan();
  return plan_.missing();
}

void TableFolder::keep(int i, const SampledBranch& branch, bool regularised) const {
  folder_.keep(record(i, regularised), to_bytes(branch, hash_));
}

Claim TableFolder::claim(int i) const { return folder_.claim(fmt::format("branch-{:04}", i)); }

SampledBranch TableFolder::read(int i, bool regularised) const {
  const fs::path file = folder_.record(record(i, regularised));
  SampledBranch branch = branch_from_bytes(folder_.content(record(i, regularised)), hash_, file.string());
  if (!branch.empty() && !is_cell_of(place(i), branch))
    refuse_path(file, "this record holds another cell of the sweep; delete it, and it is computed again.");
  return branch;
}

SampledBranch TableFolder::branch(int i, bool regularised) const {
  const std::lock_guard lock(plan_mutex_);
  const auto branch = plan_.branch({i, regularised});
  assert(branch);
  return *branch;
}

std::vector<SampledBranch> TableFolder::read_all() const {
  if (const auto lacking = missing(); !lacking.empty())
    return read(lacking.front().place, lacking.front().regularised), std::vector<SampledBranch>();
  std::vector<SampledBranch> all;
  for (int i = 0; i < branches(); ++i) {
    all.push_back(branch(i, false));
    if (!spec_.wants_regularised()) continue;
    SampledBranch regularised = branch(i, true);
    if (!regularised.empty() || has(i, true)) all.push_back(std::move(regularised));
  }
  return all;
}

bool TableFolder::lacks_tube() const {
  std::error_code error;
  return spec_.tube_table && !fs::exists(path() / tube_table_file, error);
}

std::optional<GridContent> TableFolder::tube() const {
  if (!spec_.tube_table) return {};
  constexpr std::size_t enough = std::size_t{1} << 30U;
  const fs::path file = path() / tube_table_file;
  return grid_from_bytes(first_bytes(file, enough).value_or(""), file.string());
}

std::vector<SampledBranch> TableFolder::all_branches() const {
  auto branches = read_all();
  if (!spec_.is_square()) return branches;
  const auto tube_table = tube();
  const GridContent* reference = tube_table ? &*tube_table : nullptr;
  const auto is_own = [](const SampledBranch& branch) { return branch.bending_kBT == 0; };
  const auto first_regularised = std::stable_partition(branches.begin(), branches.end(), is_own);
  auto all = square_branches(spec_, {branches.begin(), first_regularised}, reference);
  if (can_lie_between({first_regularised, branches.end()}))
    std::ranges::move(square_branches(spec_, {first_regularised, branches.end()}, reference), std::back_inserter(all));
  return all;
}

}  // namespace rheocyte
