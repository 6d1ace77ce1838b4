#include "table/finish_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "table/combined_table.h"
#include "table/elongated_table.h"
#include "table/grid_from_branches.h"
#include "table/lookup_table.h"
#include "table/simulations_file.h"

namespace rheocyte {

namespace {

void write_combined(const TableFolder& folder, const std::vector<SampledBranch>& branches) {
  const CombinedTable table = make_combined_table(folder.spec(), branches);
  folder.publish(combined_table_name(folder.spec()), combined_table_csv(table));
  folder.publish(combined_file_name(folder.spec().identifier), to_bytes(table));
  folder.publish("end-of-branch.csv", combined_ends_csv(folder.spec(), branches));
}

std::vector<std::string> write_simple(const TableFolder& folder, const std::vector<SampledBranch>& branches,
                                      std::span<const double> levels, std::string_view version) {
  const LookupTable table = make_lookup_table(folder.spec(), branches, version);
  for (const auto& [name, content] : table_files(table, levels)) folder.publish(name, content);
  folder.publish(fmt::format("simulations_{}.h5", folder.spec().identifier), simulations_file(table));
  const auto grid = make_stiffness_grid(folder.spec(), branches, version);
  if (!grid) return {"the branches are too few or too short for a grid; `rheocyte extract` takes the text table."};
  folder.publish(grid_file_name(folder.spec().identifier), to_bytes(*grid));
  return {};
}

}  // namespace

std::vector<std::string> finish_table(const TableFolder& folder, std::span<const double> levels,
                                      std::string_view version) {
  const TableSpec& spec = folder.spec();
  std::vector<std::string> sentences;
  if (spec.is_combined())
    write_combined(folder, folder.all_branches());
  else if (spec.is_elongated())
    folder.publish(elongated_file_name(spec.identifier), to_bytes(elongated_content(spec, folder.read_all(), version)));
  else
    sentences = write_simple(folder, folder.all_branches(), levels, version);
  folder.tidy();
  return sentences;
}

std::string summary(const TableFolder& folder) {
  int samples = 0, refused = 0, solves = 0, unstable = 0, short_of_range = 0, without_states = 0;
  double seconds = 0, factorisation = 0;
  for (const SampledBranch& branch : folder.read_all()) {
    samples += branch.samples();
    refused += branch.refused;
    solves += branch.solves;
    seconds += branch.seconds;
    factorisation += branch.factorisation_seconds;
    without_states += folder.spec().is_square() && branch.empty();
    if (branch.bending_kBT > 0 || branch.empty()) continue;  // those that go on where others have ended
    const Status end = branch.end.status;
    unstable += end == Status::surface_unstable;
    short_of_range += end != Status::surface_unstable && end != Status::covered && end != Status::dented;
  }
  return fmt::format(
      "{} states on {} branches, {} solves, {:.0f} s of one processor ({:.0f} % factorisation)\n"
      "{} branches end at the instability of the surface, {} short of the range for other reasons (end-of-branch.csv); "
      "{} states refused{}\n",
      samples, folder.branches(), solves, seconds, 100 * factorisation / std::max(seconds, 1e-9), unstable,
      short_of_range, refused,
      without_states > 0 ? fmt::format("; {} branches have no states and are left out", without_states) : "");
}

}  // namespace rheocyte
