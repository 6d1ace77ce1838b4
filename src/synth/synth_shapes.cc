#include "synth/synth_shapes.h"

#include <fmt/format.h>

#include <set>
#include <system_error>

#include "case/case_text.h"
#include "case/joined.h"
#include "case/refuse_path.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "store/read_file.h"
#include "synth/analytic_shapes.h"
#include "synth/branch_shapes.h"
#include "synth/combined_shapes.h"
#include "synth/course_shapes.h"
#include "synth/elongated_shapes.h"
#include "synth/grid_shapes.h"
#include "table/stiffness_grid.h"
#include "table/table_folder.h"
#include "table/table_metadata.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view is_stationary =
    "is a table of stationary shapes; recording.places_um needs a dynamic table (`rheocyte help dynamic`).";

std::string cells_of(const Case& base) { return cells_in_words(model_text(base), base.channel.section); }

// Those that are there: a table that is still being computed serves, too.
std::vector<SampledBranch> finished_branches(const TableFolder& folder) {
  std::vector<SampledBranch> branches;
  for (int i = 0; i < folder.branches(); ++i)
    for (const bool held : {false, true})
      if (folder.has(i, held)) branches.push_back(folder.read(i, held));
  std::erase_if(branches, [](const SampledBranch& branch) { return branch.empty(); });
  return branches;
}

SimulatedCells simulated_cells(const SynthSpec& spec, const Case& base) {
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
  return std::make_unique<CombinedShapes>(folder.spec(), std::move(branches),
                                          simulated_cells(spec, folder.spec().base));
}

/// A table as one file.
std::unique_ptr<CellShapes> shapes_of_combined_file(SynthSpec& spec) {
  if (spec.kind != CellKind::combined)
    refuse_path(spec.table, "its cells have a bulk and a cortex, so cell.kind must be \"combined\".");
  if (spec.is_on_its_way()) refuse_path(spec.table, is_stationary);
  const CombinedTable table = read_combined_table(spec.table);
  spec.made_of = cells_of(table.spec.base);
  check_tensions(spec, table.spec.tension_ratios);
  return std::make_unique<CombinedShapes>(table, simulated_cells(spec, table.spec.base));
}

std::unique_ptr<CellShapes> shapes_of_dynamic_table(SynthSpec& spec) {
  if (!spec.is_on_its_way())
    refuse_path(spec.table, "is a dynamic table; give recording.places_um, where its cells are seen.");
  if (!spec.viscosity_of_cell_mPas)
    refuse_path(spec.table, "is a dynamic table; give cell.viscosity_mPas of its cells.");
  if (spec.kind != CellKind::solid) refuse_path(spec.table, "its cells are solids, so cell.kind must be \"solid\".");
  DynamicTable table = read_dynamic_table(spec.table);
  spec.made_of = cells_of(table.spec().base);
  return std::make_unique<CourseShapes>(std::move(table), ChannelFlow{spec.channel_width_um, spec.flow_rate_ul_s});
}

std::unique_ptr<CellShapes> shapes_of_elongated(SynthSpec& spec, const fs::path& file) {
  ElongatedContent content =
      elongated_from_bytes(content_of_file(file, largest_elongated), one_line(file.string(), 300));
  if (spec.kind != CellKind::solid) refuse_path(spec.table, "its cells are solids, so cell.kind must be \"solid\".");
  if (spec.is_on_its_way()) refuse_path(spec.table, is_stationary);
  spec.made_of = content.origin.cells();
  return std::make_unique<ElongatedCellShapes>(std::move(content),
                                               ChannelFlow{spec.channel_width_um, spec.flow_rate_ul_s});
}

std::unique_ptr<CellShapes> shapes_of_grid(SynthSpec& spec) {
  const std::string name = one_line(spec.table.string(), 300);
  const std::string file_name = spec.table.filename().string();
  if (file_name.starts_with("elongated_")) return shapes_of_elongated(spec, spec.table);
  if (file_name.starts_with("combined_")) return shapes_of_combined_file(spec);
  if (file_name.starts_with("dynamic_")) return shapes_of_dynamic_table(spec);
  GridContent grid = grid_from_bytes(content_of_file(spec.table, largest_grid), name);
  if (grid.origin.is_shell || spec.kind != CellKind::solid)
    refuse_path(spec.table,
                "shapes come from a grid of solids only, so cell.kind must be \"solid\"; of other cells give "
                "the folder of a table.");
  if (!grid.shapes)
    refuse_path(spec.table, "does not contain the shapes of its cells; compute it again with `rheocyte table`.");
  if (spec.is_on_its_way()) refuse_path(spec.table, is_stationary);
  spec.made_of = grid.origin.cells();
  return std::make_unique<GridShapes>(std::move(grid), ChannelFlow{spec.channel_width_um, spec.flow_rate_ul_s});
}

std::unique_ptr<CellShapes> shapes_of_table(SynthSpec& spec) {
  std::error_code error;
  if (fs::is_regular_file(spec.table, error)) return shapes_of_grid(spec);
  if (!fs::exists(spec.table / "spec.toml", error))
    refuse_path(
        spec.table,
        "there is no table of `rheocyte table` (no spec.toml in this folder) and none of the program of this name; "
        "shapes.table names such a folder or table.");
  const fs::path file = spec.table / "spec.toml";
  if (is_dynamic_spec(read_case_text(file, specification("table")), file.string(), {}))
    return shapes_of_dynamic_table(spec);
  if (spec.is_on_its_way()) refuse_path(spec.table, is_stationary);
  const TableFolder folder(spec.table, read_table_spec(file));
  spec.made_of = cells_of(folder.spec().base);
  if (folder.spec().is_combined()) return shapes_of_combined_table(spec, folder);
  if (folder.spec().is_elongated()) {
    const fs::path elongated = spec.table / to_path(elongated_file_name(folder.spec().identifier));
    if (!fs::exists(elongated, error)) refuse_path(spec.table, "is not finished; continue `rheocyte table`.");
    return shapes_of_elongated(spec, elongated);
  }
  const bool is_shell = folder.spec().sweeps_cortex();
  if (spec.kind != (is_shell ? CellKind::shell : CellKind::solid))
    refuse_path(spec.table, fmt::format("its cells differ by {}, so cell.kind must be \"{}\".",
                                        folder.spec().stiffness_key, is_shell ? "shell" : "solid"));
  auto branches = folder.spec().is_square() ? folder.all_branches() : finished_branches(folder);
  std::set<double> radii;
  for (const auto& branch : branches) radii.insert(branch.radius_um);
  if (radii.size() < 2) refuse_path(spec.table, "has fewer than two finished branches; continue `rheocyte table`.");
  return std::make_unique<BranchShapes>(std::move(branches), simulated_cells(spec, folder.spec().base));
}

void check_elongation(const SynthSpec& spec, std::optional<Elongation> of_table) {
  if (spec.axial_tension_Pa && of_table != Elongation::by_tension)
    refuse_path(spec.table,
                "its cells are not elongated by a tension; flow.axial_tension_Pa needs a table with table.axial_ratio, "
                "for example HE-3D-el-26 of the program.");
  if (spec.rest_aspect && of_table != Elongation::by_rest_shape)
    refuse_path(
        spec.table,
        "its cells are spheres at rest; cell.rest_aspect needs a table with table.elongated_by = \"rest-shape\" "
        "(docs/tables.md, sec. \"Elongated cells\"), none of which comes with the program.");
}

}  // namespace

std::unique_ptr<CellShapes> shapes_of(SynthSpec& spec) {
  if (!spec.analytical) {
    auto shapes = shapes_of_table(spec);
    check_elongation(spec, shapes->elongation());
    return shapes;
  }
  spec.made_of = cells_in_words(spec.kind == CellKind::shell ? "linear shell" : "linear solid", Section::tube);
  return std::make_unique<AnalyticShapes>(
      AnalyticPopulation{.flow = {spec.channel_width_um, spec.flow_rate_ul_s},
                         .is_shell = spec.kind == CellKind::shell,
                         .tension_ratio = spec.tension_ratio.value_or(Spread{}).mean,
                         .duct = spec.square_duct ? Duct::square : Duct::tube,
                         .max_deformation = spec.max_deformation});
}

}  // namespace rheocyte
