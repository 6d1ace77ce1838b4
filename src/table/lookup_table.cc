#include "table/lookup_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "table/table_lines.h"
#include "table/table_metadata.h"

namespace rheocyte {

namespace {

bool ends_early(const RadiusBranches& radius) { return radius.bare() && radius.bare()->end.status != Status::covered; }

TableRow end_row(const RadiusBranches& radius) {
  TableRow row = row_at(radius, point_at(*radius.bare(), radius.bare()->stiffness.back()));
  row.is_end = true;
  return row;
}

std::vector<TableRow> rows_at(const TableSpec& spec, const RadiusBranches& radius, const std::vector<double>& levels) {
  std::vector<TableRow> rows;
  for (const double level : levels) {
    const auto state = radius.at_deformation(level);
    if (!state || (state->regularised && !spec.wants_regularised())) continue;
    rows.push_back(row_at(radius, *state));
    rows.back().value(int(Measure::deformation)) = level;
  }
  if (ends_early(radius)) {
    const auto is_same = [end = end_row(radius).at(Measure::deformation)](const TableRow& row) {
      return std::abs(row.at(Measure::deformation) / end - 1) < 1e-6;
    };
    std::erase_if(rows, is_same);  // two rows at one place would be of no use to a triangulation
    rows.push_back(end_row(radius));
  }
  std::ranges::stable_sort(rows, {}, [](const TableRow& row) { return row.at(Measure::deformation); });
  std::erase_if(rows, [&](const TableRow& row) { return !is_inside(spec, row); });
  return rows;
}

// Every other column has its rows between those of its neighbours. Rows at one level would be corners of rectangles,
// whose four corners lie on one circle: which diagonal divides them would be left to rounding, in each program and at
// each channel width another.
std::vector<double> levels_of_column(const std::vector<double>& levels, std::size_t column) {
  if (column % 2 == 0) return levels;
  std::vector<double> between{levels.front()};
  for (std::size_t k = 1; k < levels.size(); ++k) between.push_back(std::sqrt(levels[k - 1] * levels[k]));
  between.push_back(levels.back());
  return between;
}

// The last bare states of those radii whose rows go on with bending.
void add_regularisation(nlohmann::ordered_json& metadata, const LookupTable& table) {
  auto area = nlohmann::ordered_json::array(), deformation = area;
  for (const auto& radius : table.radii) {
    const bool goes_on = std::ranges::any_of(
        table.rows, [&](const TableRow& row) { return row.radius_um == radius.radius_um() && row.state.regularised; });
    if (!goes_on || !radius.bare()) continue;
    const TableRow row = end_row(radius);
    area.push_back(row.at(Measure::area_um2));
    deformation.push_back(row.at(Measure::deformation));
  }
  metadata["regularised_rows"] = table.regularised_rows();
  if (area.empty()) return;
  metadata["regularised_beyond_area_um2"] = std::move(area);
  metadata["regularised_beyond_deformation"] = std::move(deformation);
}

struct LutPoint {
  std::array<double, 3> row;
  bool regularised;
};

// Spheres of one radius have one volume.
std::vector<LutPoint> points_by_volume(const LookupTable& table) {
  const auto levels = deformation_levels(table.spec);
  std::vector<LutPoint> points;
  for (std::size_t i = 0; i < table.radii.size(); ++i)
    for (const auto& row : rows_at(table.spec, table.radii[i], levels_of_column(levels, i)))
      points.push_back(
          {{row.at(Measure::volume_um3), row.at(Measure::deformation), row.state.stiffness}, row.state.regularised});
  return points;
}

std::vector<LutPoint> points_by_area(const LookupTable& table) {
  const TableSpec& spec = table.spec;
  std::vector<LutPoint> points;
  for (const auto& [area, level] : text_places(spec))
    if (const auto answer = table.between.by_area(area, level); answer.reason == OutOfTable::none)
      points.push_back({{area, level, answer.stiffness}, answer.regularised});
  for (const auto& row : table.rows)
    if (row.is_end && !spec.wants_regularised())
      points.push_back({{row.at(Measure::area_um2), row.at(Measure::deformation), row.state.stiffness}, false});
  return points;
}

std::string csv_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string regularising_bending_text(const TableSpec& spec) {
  if (spec.bending_beyond_ratio == 0) return fmt::format("{:g} kBT", spec.bending_beyond_kBT);
  return fmt::format("{:g} {}", spec.bending_beyond_ratio, spec.sweeps_cortex() ? "E2D r0^2" : "E r0^3");
}

}  // namespace

TableRow row_at(const RadiusBranches& radius, const BranchPoint& state) {
  return {radius.radius_um(), state, interpolate(*state.branch, state.stiffness), stiffness_error(state), false};
}

bool is_inside(const TableSpec& spec, const TableRow& row) {
  const double area = row.at(Measure::area_um2), d = row.at(Measure::deformation);
  return area >= spec.min_area_um2 && area <= spec.max_area_um2 && d >= spec.min_deformation &&
         d <= spec.max_deformation;
}

std::string LookupTable::program() const { return fmt::format("{}{}", table_mark.substr(2), version); }

int LookupTable::regularised_rows() const {
  return int(std::ranges::count_if(rows, [](const TableRow& row) { return row.state.regularised; }));
}

std::vector<double> deformation_levels(const TableSpec& spec) {
  const double range = std::log(spec.max_deformation / spec.min_deformation);
  std::vector<double> levels;
  for (int i = 0; i < spec.rows_per_radius; ++i)
    levels.push_back(spec.min_deformation * std::exp(range * i / (spec.rows_per_radius - 1)));
  levels.back() = spec.max_deformation;
  return levels;
}

std::vector<LutNode> text_places(const TableSpec& spec) {
  const double first = std::sqrt(spec.min_area_um2), last = std::sqrt(spec.max_area_um2);
  const auto levels = deformation_levels(spec);
  std::vector<LutNode> places;
  for (int i = 0; i < spec.radii; ++i) {
    const double root = first + (last - first) * i / (spec.radii - 1);
    const double area = std::clamp(root * root, spec.min_area_um2, spec.max_area_um2);
    for (const double level : levels_of_column(levels, std::size_t(i))) places.push_back({area, level});
  }
  return places;
}

LookupTable make_lookup_table(const TableSpec& spec, std::span<const SampledBranch> branches,
                              std::string_view version) {
  LookupTable table{spec, std::string(version), by_radius(branches), TableInterpolation(spec, branches), {}};
  const auto levels = deformation_levels(spec);
  for (const auto& radius : table.radii)
    std::ranges::move(rows_at(spec, radius, levels), std::back_inserter(table.rows));
  return table;
}

TableText empty_text(const TableSpec& spec, const std::string& program, bool has_regularised) {
  TableText text;
  text.comments = {
      fmt::format("{}: stationary shapes of cells in the channel of RT-DC.", program),
      "Area and deformation are those of the convex contour that a camera sees, without any pixelation.",
      fmt::format("Estimated relative error of the deformation at most {:g} at each computed state.", spec.accuracy)};
  if (stiffness_unit(spec) != "kPa")
    text.comments.push_back("The third column is the modulus E2D of the cortex in mN/m, whatever its name says.");
  if (spec.base.flow.law == LiquidLaw::power_law)
    text.comments.push_back("The liquid is shear-thinning; fluid_viscosity is its effective viscosity at the wall.");
  if (has_regularised) {
    text.comments.push_back(
        "Beyond the curve regularised_beyond_* the bare surface is unstable; the rows there have a");
    text.comments.push_back(fmt::format("bending stiffness of {}.", regularising_bending_text(spec)));
  }
  text.comments.emplace_back();
  text.metadata = table_metadata(spec, program);
  return text;
}

TableText empty_text(const LookupTable& table, Abscissa abscissa) {
  TableText text = empty_text(table.spec, table.program(), table.regularised_rows() > 0);
  add_regularisation(text.metadata, table);
  text.abscissa = abscissa;
  return text;
}

std::string lut_text(const LookupTable& table, Abscissa abscissa) {
  const bool by_area = abscissa == Abscissa::area;
  TableText text = empty_text(table, abscissa);
  if (!by_area) text.metadata[table_identifier_key] = table.spec.identifier + "-volume";
  const auto points = by_area ? points_by_area(table) : points_by_volume(table);
  text.metadata["regularised_rows"] = std::ranges::count(points, true, &LutPoint::regularised);
  text.metadata["rows"] = points.size();
  for (const auto& point : points) text.rows.push_back(point.row);
  return to_text(text);
}

std::string full_table_csv(const LookupTable& table) {
  std::string text = fmt::format("radius_um,{}", stiffness_column(table.spec));
  for (const auto& measure : table_measures) text += fmt::format(",{}", measure.name);
  text += ",deformation_error,stiffness_error,bending_kBT,regularised,end_of_branch\n";
  for (const auto& row : table.rows) {
    text += fmt::format("{},{}", row.radius_um, row.state.stiffness);
    for (const double value : row.value) text += fmt::format(",{}", value);
    const double bending = row.state.regularised
                               ? regularising_bending_kBT(table.spec, row.radius_um, row.state.stiffness)
                               : table.spec.base.cell.cortex.bending_kBT;
    text += fmt::format(",{},{},{},{:d},{:d}\n", row.state.error, row.stiffness_error, bending, row.state.regularised,
                        row.is_end);
  }
  return text;
}

std::string end_of_branch_csv(const LookupTable& table) {
  std::string text =
      fmt::format("radius_um,{},area_um2,deformation,volume_um3,least_meridional_stretch,status,reason\n",
                  stiffness_column(table.spec));
  for (const auto& radius : table.radii) {
    if (!ends_early(radius)) continue;
    const TableRow row = end_row(radius);
    const auto& end = radius.bare()->end;
    text += fmt::format("{},{},{},{},{},{},{},{}\n", row.radius_um, row.state.stiffness, row.at(Measure::area_um2),
                        row.at(Measure::deformation), row.at(Measure::volume_um3),
                        row.at(Measure::min_meridional_stretch), name(end.status), csv_text(end.message));
  }
  return text;
}

std::string regularisation_csv(const LookupTable& table) {
  std::string text = fmt::format("radius_um,{},area_um2,bending_kBT,deformation,deformation_held,relative_change\n",
                                 stiffness_column(table.spec));
  for (const auto& radius : table.radii) {
    const SampledBranch *bare = radius.bare(), *regularised = radius.regularised();
    for (int i = 0; bare && regularised && i < regularised->samples(); ++i) {
      const double stiffness = regularised->stiffness[std::size_t(i)];
      if (stiffness > bare->stiffness.front() || stiffness < bare->stiffness.back()) continue;
      const double d = interpolate(*bare, Measure::deformation, stiffness),
                   with = regularised->at(i, Measure::deformation);
      text += fmt::format("{},{},{},{},{},{},{:.3g}\n", radius.radius_um(), stiffness,
                          interpolate(*bare, Measure::area_um2, stiffness),
                          regularising_bending_kBT(table.spec, radius.radius_um(), stiffness), d, with, with / d - 1);
    }
  }
  return text;
}

std::vector<TableFile> table_files(const LookupTable& table, std::span<const double> levels) {
  const auto chosen = levels.empty() ? line_levels(table) : std::vector<double>(levels.begin(), levels.end());
  const std::string& id = table.spec.identifier;
  std::vector<TableFile> files{
      {fmt::format("lut_{}.txt", id), lut_text(table, Abscissa::area)},
      {fmt::format("lut_{}_volume.txt", id), lut_text(table, Abscissa::volume)},
      {fmt::format("iso_{}-area_um-deform.txt", id), lines_text(table, chosen, Abscissa::area)},
      {fmt::format("iso_{}-volume-deform.txt", id), lines_text(table, chosen, Abscissa::volume)},
      {fmt::format("table_{}.csv", id), full_table_csv(table)},
      {"end-of-branch.csv", end_of_branch_csv(table)},
      {"spec.toml", to_toml(table.spec)}};
  if (table.spec.wants_regularised()) files.push_back({"regularisation.csv", regularisation_csv(table)});
  return files;
}

}  // namespace rheocyte
