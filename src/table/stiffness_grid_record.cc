// The file of a grid.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "numeric/fingerprint.h"
#include "table/checked_record.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

namespace {

using nlohmann::json;

constexpr RecordKind grid_kind{"rheocyte grid", "1", "grid of a table",
                               "`rheocyte table` with the table's spec writes it anew"};
constexpr int max_side = 10000;
/// Only in grids of square channels; keys of a record stand in the order of their letters, and this one comes first.
constexpr const char *section_key = "channel_section", *square_section = "square";

json record_of(const GridPatch& patch) {
  return {{"regularised", patch.regularised},
          {"first_column", patch.first_column},
          {"columns", patch.columns},
          {"rows", patch.rows},
          {"lower", blob_of(patch.lower)},
          {"upper", blob_of(patch.upper)},
          {"log_stiffness", blob_of(patch.log_stiffness)},
          {"error", blob_of(patch.error)},
          {"beyond", blob_of(patch.beyond)}};
}

json record_of(const ShapeNodes& shapes) {
  json modes = json::array();
  for (const auto& mode : shapes.modes) modes.push_back(blob_of(mode));
  return {{"least_log_area", shapes.min_log_area},
          {"column_step", shapes.column_step},
          {"columns", shapes.columns},
          {"rows", shapes.rows},
          {"lower", blob_of(shapes.lower)},
          {"upper", blob_of(shapes.upper)},
          {"inertia_ratio", blob_of(shapes.inertia_ratio)},
          {"modes", std::move(modes)}};
}

json record_of(const GridContent& grid) {
  const TableOrigin& o = grid.origin;
  json patches = json::array();
  for (const auto& patch : grid.patches) patches.push_back(record_of(patch));
  json record = {{"identifier", o.identifier},
                 {"model", o.model},
                 {"program", o.program},
                 {"spec", o.spec},
                 {"channel_width_um", o.flow.width_um},
                 {"flow_rate_ul_per_s", o.flow.rate_ul_s},
                 {"viscosity_mPas", o.flow.viscosity_mPas},
                 {"flow_exponent", o.flow.exponent},
                 {"is_shell", o.is_shell},
                 {"least_log_area", grid.min_log_area},
                 {"column_step", grid.column_step},
                 {"columns", grid.columns},
                 {"patches", std::move(patches)}};
  if (o.section == Section::square) record[section_key] = square_section;
  if (grid.shapes) record["shapes"] = record_of(*grid.shapes);
  return record;
}

int side(const json& record, const char* key, int least, int greatest) {
  const int value = record.at(key);
  check_record(value >= least && value <= greatest, "a size is out of range");
  return value;
}

double positive(const json& record, const char* key) {
  const double value = record.at(key);
  check_record(value > 0 && std::isfinite(value), "a number is out of range");
  return value;
}

/// Logarithms of anything that is measured are below this.
constexpr double max_log = 100;
/// Where a table is coarse its errors have no meaning, but they are none of these.
constexpr double max_error = 1e6;

// A state without an answer is no node: all numbers of a grid are finite, and of a size that cells have.
std::vector<double> numbers_between(const json& record, const char* key, std::size_t size, double least,
                                    double greatest) {
  auto values = numbers_of(record, key, size);
  check_record(std::ranges::all_of(values, [&](double v) { return v >= least && v <= greatest; }),
               "a number is not one that cells have");
  return values;
}

std::vector<double> logarithms(const json& record, const char* key, std::size_t size) {
  return numbers_between(record, key, size, -max_log, max_log);
}

/// Of the first and the last column.
void check_areas(double min_log_area, double column_step, int columns) {
  check_record(std::abs(min_log_area) < max_log && std::abs(min_log_area + column_step * columns) < max_log,
               "an area is out of range");
}

GridPatch patch_of(const json& record, int columns) {
  GridPatch patch;
  patch.regularised = record.at("regularised");
  patch.columns = side(record, "columns", 2, columns);
  patch.first_column = side(record, "first_column", 0, columns - patch.columns);
  patch.rows = side(record, "rows", 2, max_side);
  const auto wide = static_cast<std::size_t>(patch.columns), all = wide * static_cast<std::size_t>(patch.rows);
  patch.lower = logarithms(record, "lower", wide);
  patch.upper = logarithms(record, "upper", wide);
  patch.log_stiffness = logarithms(record, "log_stiffness", all);
  patch.error = numbers_between(record, "error", all, 0, max_error);
  patch.beyond = numbers_between(record, "beyond", wide, 0, static_cast<double>(NoAnswer::unresolved));
  for (std::size_t c = 0; c < wide; ++c) check_record(patch.upper[c] > patch.lower[c], "a column has no height");
  return patch;
}

ShapeNodes shapes_of(const json& record) {
  ShapeNodes shapes;
  shapes.min_log_area = record.at("least_log_area");
  shapes.column_step = positive(record, "column_step");
  shapes.columns = side(record, "columns", 2, max_side);
  shapes.rows = side(record, "rows", 2, max_side);
  check_areas(shapes.min_log_area, shapes.column_step, shapes.columns);
  const auto wide = static_cast<std::size_t>(shapes.columns), all = wide * static_cast<std::size_t>(shapes.rows);
  shapes.lower = logarithms(record, "lower", wide);
  shapes.upper = logarithms(record, "upper", wide);
  for (std::size_t c = 0; c < wide; ++c) check_record(shapes.upper[c] > shapes.lower[c], "a column has no height");
  shapes.inertia_ratio = numbers_between(record, "inertia_ratio", all, 1 / max_log, max_log);
  const json& modes = record.at("modes");
  check_record(modes.is_array() && modes.size() == shapes.modes.size(), "its modes are others");
  for (std::size_t k = 0; k < shapes.modes.size(); ++k) {
    const json one = {{"mode", modes[k]}};
    shapes.modes[k] = numbers_between(one, "mode", all, -1, 1);
  }
  return shapes;
}

GridContent content_of(const json& record) {
  GridContent grid;
  TableOrigin& o = grid.origin;
  o.identifier = record.at("identifier");
  o.model = record.at("model");
  o.program = record.at("program");
  o.spec = record.at("spec");
  o.flow.width_um = positive(record, "channel_width_um");
  o.flow.rate_ul_s = positive(record, "flow_rate_ul_per_s");
  o.flow.viscosity_mPas = positive(record, "viscosity_mPas");
  o.flow.exponent = positive(record, "flow_exponent");
  o.is_shell = record.at("is_shell");
  if (record.contains(section_key)) {
    check_record(record.at(section_key) == square_section, "a section is unknown");
    o.section = Section::square;
  }
  grid.min_log_area = record.at("least_log_area");
  grid.column_step = positive(record, "column_step");
  grid.columns = side(record, "columns", 2, max_side);
  check_areas(grid.min_log_area, grid.column_step, grid.columns);
  for (const auto& patch : record.at("patches")) grid.patches.push_back(patch_of(patch, grid.columns));
  check_record(!grid.patches.empty(), "it has no states");
  if (record.contains("shapes")) grid.shapes = shapes_of(record.at("shapes"));
  return grid;
}

}  // namespace

std::string TableOrigin::description() const {
  const auto conditions =
      fmt::format("{} um, {} ul/s, {:.6g} mPa s", flow.width_um, flow.rate_ul_s, flow.viscosity_mPas);
  return model.empty() ? fmt::format("{} ({})", identifier, conditions)
                       : fmt::format("{} ({}, {}, by {})", identifier, model, conditions, program);
}

std::string TableOrigin::cells() const { return cells_in_words(model, section); }

std::string cells_in_words(std::string_view model, Section section) {
  std::string cells(model.substr(0, model.find(" / ")));
  if (cells.empty()) return cells;
  for (const auto& [written, name] : {std::pair<std::string_view, std::string_view>{"neo-hookean", "neo-Hookean"},
                                      {"mooney-rivlin", "Mooney-Rivlin"}})
    if (const auto at = cells.find(written); at != std::string::npos) cells.replace(at, written.size(), name);
  return fmt::format("{}s in the {}", cells, section == Section::square ? "square channel" : "tube");
}

std::string to_bytes(const GridContent& grid) {
  return sealed_record(grid_kind, fingerprint(grid.origin.spec), record_of(grid));
}

// Keys of a record stand in the order of their letters, so the long columns of numbers come behind these.
std::optional<GridHead> grid_head(std::string_view head) {
  head = head.substr(0, grid_head_bytes);
  constexpr std::size_t longest = 200;  // bytes of CBOR
  const auto value_of = [head](std::string_view key) {
    const auto place = head.find(key);
    if (place == std::string_view::npos) return json();
    const auto value = head.substr(place + key.size(), longest);
    constexpr unsigned char first_of_lists = 0x80, first_of_numbers = 0xe0;  // lists would let the reader nest
    if (value.empty() || (static_cast<unsigned char>(value.front()) >= first_of_lists &&
                          static_cast<unsigned char>(value.front()) < first_of_numbers))
      return json();
    return json::from_cbor(value.begin(), value.end(), false, false);
  };
  const json exponent = value_of("flow_exponent"), model = value_of("model");
  if (!exponent.is_number() || !model.is_string()) return {};
  return GridHead{exponent.get<double>(),
                  head.find(section_key) != std::string_view::npos ? Section::square : Section::tube,
                  model.get<std::string>()};
}

GridContent grid_from_bytes(std::string_view bytes, const std::string& name) {
  return read_or_refuse(grid_kind, name, [&] { return content_of(opened_record(grid_kind, bytes).record); });
}

}  // namespace rheocyte
