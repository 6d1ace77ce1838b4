// The file of a grid: in single precision, but for the places of its nodes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "numeric/fingerprint.h"
#include "table/checked_record.h"
#include "table/origin_record.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

namespace {

using nlohmann::json;

constexpr RecordKind grid_kind{"rheocyte grid", "2", "grid of a table",
                               "`rheocyte table` with the table's spec writes it again", "1"};
constexpr int max_side = 10000;

json record_of(const GridPatch& patch) {
  return {{"regularised", patch.regularised},
          {"first_column", patch.first_column},
          {"columns", patch.columns},
          {"rows", patch.rows},
          {"lower", blob_of(patch.lower)},
          {"upper", blob_of(patch.upper)},
          {"log_stiffness", single_blob_of(patch.log_stiffness)},
          {"error", single_blob_of(patch.error)},
          {"beyond", single_blob_of(patch.beyond)}};
}

json record_of(const ShapeNodes& shapes) {
  json modes = json::array();
  for (const auto& mode : shapes.modes) modes.push_back(single_blob_of(mode));
  return {{"least_log_area", shapes.min_log_area},
          {"column_step", shapes.column_step},
          {"columns", shapes.columns},
          {"rows", shapes.rows},
          {"lower", blob_of(shapes.lower)},
          {"upper", blob_of(shapes.upper)},
          {"inertia_ratio", single_blob_of(shapes.inertia_ratio)},
          {"modes", std::move(modes)}};
}

json record_of(const GridContent& grid) {
  json patches = json::array();
  for (const auto& patch : grid.patches) patches.push_back(record_of(patch));
  json record = {{"least_log_area", grid.min_log_area},
                 {"column_step", grid.column_step},
                 {"columns", grid.columns},
                 {"patches", std::move(patches)}};
  put_origin(grid.origin, record);
  if (grid.shapes) record["shapes"] = record_of(*grid.shapes);
  return record;
}

int side(const json& record, const char* key, int least, int greatest) {
  const int value = record.at(key);
  check_record(value >= least && value <= greatest, "a size is out of range");
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
  patch.beyond = numbers_between(record, "beyond", wide, 0, static_cast<double>(OutOfTable::unresolved));
  for (std::size_t c = 0; c < wide; ++c) check_record(patch.upper[c] > patch.lower[c], "a column has no height");
  return patch;
}

ShapeNodes shapes_of(const json& record) {
  ShapeNodes shapes;
  shapes.min_log_area = record.at("least_log_area");
  shapes.column_step = positive_number(record, "column_step");
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
  grid.origin = origin_from(record);
  grid.min_log_area = record.at("least_log_area");
  grid.column_step = positive_number(record, "column_step");
  grid.columns = side(record, "columns", 2, max_side);
  check_areas(grid.min_log_area, grid.column_step, grid.columns);
  for (const auto& patch : record.at("patches")) grid.patches.push_back(patch_of(patch, grid.columns));
  check_record(!grid.patches.empty(), "it has no states");
  if (record.contains("shapes")) grid.shapes = shapes_of(record.at("shapes"));
  return grid;
}

}  // namespace

std::string to_bytes(const GridContent& grid) {
  return sealed_record(grid_kind, fingerprint(grid.origin.spec), record_of(grid));
}

GridContent grid_from_bytes(std::string_view bytes, const std::string& name) {
  return read_or_refuse(grid_kind, name, [&] { return content_of(opened_record(grid_kind, bytes).record); });
}

}  // namespace rheocyte
