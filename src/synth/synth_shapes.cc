#include "synth/synth_shapes.h"

#include <fmt/format.h>

#include <set>
#include <system_error>

#include "case/case_text.h"
#include "case/joined.h"
#include "case/refuse_path.h"
#include "synth/analytic_shapes.h"
#include "synth/branch_shapes.h"
#include "synth/combined_shapes.h"
#include "synth/course_shapes.h"
#include "table/table_folder.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// Those that are there: a table that is still being computed serves, too.
std::vector<SampledBranch> finished_branches(const TableFolder& folder) {
  std::vector<SampledBranch> branches;
  for (int i = 0; i < folder.branches(); ++i)
    for (const bool held : {false, true})
      if (folder.has(i, held)) branches.push_back(folder.read(i, held));
  std::erase_if(branches, [](const SampledBranch& branch) { return branch.empty(); });
  return branches;
}

SimulatedCells cells_of(const SynthSpec& spec, const Case& base) {
  return {.simulated = channel_flow_of(base),
          .flow = {spec.channel_width_um, spec.flow_rate_ul_s},
          .is_shell = spec.kind == CellKind::shell};
}

void check_tensions(SynthSpec& spec, const std::vector<double>& ratios) {
  const bool is_given = spec.tension_ratio || spec.tension_mN_per_m;
  if (ratios.size() > 1) {
    if (!is_given)
      refuse_path(
          spec.table,
          fmt::format("has the tensions {} in E2D; give cell.cortex.tension_ratio or cell.cortex.tension_mN_per_m.",
                      joined(ratios, ", ")));
    return;
  }
  if (is_given)
    refuse_path(
        spec.table,
        fmt::format("all its cells have the tension {:g} E2D; remove {}, or take a table with several numbers "
                    "in table.tension_ratio.",
                    ratios.front(), spec.tension_ratio ? "cell.cortex.tension_ratio" : "cell.cortex.tension_mN_per_m"));
  spec.tension_ratio = Spread{Spread::Law::normal, ratios.front(), 0};
}

std::unique_ptr<CellShapes> shapes_of_combined_table(SynthSpec& spec, const TableFolder& folder) {
  if (spec.kind != CellKind::combined)
    refuse_path(spec.table, "its cells have a bulk and a cortex, so cell.kind must be \"combined\".");
  auto branches = finished_branches(folder);
  check_tensions(spec, folder.spec().tension_ratios);
  return std::make_unique<CombinedShapes>(folder.spec(), std::move(branches), cells_of(spec, folder.spec().base));
}

std::unique_ptr<CellShapes> shapes_of_dynamic_table(const SynthSpec& spec) {
  if (!spec.is_on_its_way())
    refuse_path(spec.table, "is a dynamic table; give recording.places_um, where its cells are seen.");
  if (!spec.viscosity_of_cell_mPas)
    refuse_path(spec.table, "is a dynamic table; give cell.viscosity_mPas of its cells.");
  if (spec.kind != CellKind::solid) refuse_path(spec.table, "its cells are solids, so cell.kind must be \"solid\".");
  return std::make_unique<CourseShapes>(read_dynamic_table(spec.table),
                                        ChannelFlow{spec.channel_width_um, spec.flow_rate_ul_s});
}

std::unique_ptr<CellShapes> shapes_of_table(SynthSpec& spec) {
  std::error_code error;
  if (!fs::exists(spec.table / "spec.toml", error))
    refuse_path(
        spec.table,
        "there is no table of `rheocyte table` (no spec.toml in this folder); shapes.table names such a folder.");
  const fs::path file = spec.table / "spec.toml";
  if (is_dynamic_spec(read_case_text(file), file.string(), {})) return shapes_of_dynamic_table(spec);
  if (spec.is_on_its_way())
    refuse_path(
        spec.table,
        "is a table of stationary shapes; recording.places_um needs a dynamic table (`rheocyte help dynamic`).");
  const TableFolder folder(spec.table, read_table_spec(file));
  if (folder.spec().is_combined()) return shapes_of_combined_table(spec, folder);
  const bool is_shell = folder.spec().sweeps_cortex();
  if (spec.kind != (is_shell ? CellKind::shell : CellKind::solid))
    refuse_path(spec.table, fmt::format("its cells differ by {}, so cell.kind must be \"{}\".",
                                        folder.spec().stiffness_key, is_shell ? "shell" : "solid"));
  auto branches = folder.spec().is_square() ? folder.all_branches() : finished_branches(folder);
  std::set<double> radii;
  for (const auto& branch : branches) radii.insert(branch.radius_um);
  if (radii.size() < 2) refuse_path(spec.table, "has fewer than two finished branches; let `rheocyte table` go on.");
  return std::make_unique<BranchShapes>(std::move(branches), cells_of(spec, folder.spec().base));
}

}  // namespace

std::unique_ptr<CellShapes> shapes_of(SynthSpec& spec) {
  if (!spec.table.empty()) return shapes_of_table(spec);
  return std::make_unique<AnalyticShapes>(
      AnalyticPopulation{.flow = {spec.channel_width_um, spec.flow_rate_ul_s},
                         .is_shell = spec.kind == CellKind::shell,
                         .tension_ratio = spec.tension_ratio.value_or(Spread{}).mean,
                         .duct = spec.square_duct ? Duct::square : Duct::tube,
                         .max_deformation = spec.max_deformation});
}

}  // namespace rheocyte
