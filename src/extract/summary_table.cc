#include "extract/summary_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "case/split.h"
#include "case/user_error.h"
#include "store/claim.h"
#include "store/own_file.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "recording\tevents\tvalid\t";

/// By the names of their columns.
using Row = std::map<std::string, std::string, std::less<>>;

constexpr std::string_view columns_after_counts =
    "with_modulus_percent young_modulus_median_kPa young_modulus_first_quartile_kPa "
    "young_modulus_third_quartile_kPa young_modulus_mean_kPa young_modulus_standard_deviation_kPa "
    "young_modulus_standard_error_median_kPa recommended_modulus recommended_young_modulus_median_kPa "
    "recommended_text young_modulus_elongated_median_kPa young_modulus_elongated_first_quartile_kPa "
    "young_modulus_elongated_third_quartile_kPa with_elongation elongated_by "
    "deformation_over_elongated_modulus elongation_median elongation_median_error axial_tension_median_Pa "
    "axial_tension_median_error_Pa mode_4_beyond_solids mode_5_beyond_solids shapes shapes_of_model "
    "fitting_table modulus_over_that_of_fitting_table shape_excess_median shape_excess_median_error "
    "inertia_ratio_median inertia_ratio_expected elongated_percent odd_share_median red_cells "
    "inertia_ratio_change deformation_change deformation_change_error mode_3_change pos_y_rms_um "
    "sine_mode_2_per_um sine_mode_2_per_um_error flank_slope_per_um flank_slope_per_um_error "
    "flank_slope_per_um_change flank_slope_per_um_stored pos_y_rms_change_per_um "
    "pos_y_rms_change_per_um_error shapes_text trend_text beside_axis_text table medium viscosity_model "
    "mean_viscosity_mPas temperature channel_width_um flow_rate_ul_s pixelation_pixel_size_um "
    "corrected_for_pixels gates area_from deformation_from sample date time run_index chip remarks";

std::string number_text(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

std::string cell(std::string text) {
  std::ranges::replace(text, '\t', ' ');
  return one_line(text, 1000);
}

std::string column_of(std::string_view state) {
  std::string name(state);
  std::ranges::replace(name, ' ', '_');
  return name;
}

std::vector<std::string> columns() {
  std::vector<std::string> names{"recording", "events"};
  for (const auto state : states_by_deformation()) names.push_back(column_of(state));
  for (const auto& name : split(columns_after_counts, ' ')) names.emplace_back(name);
  return names;
}

std::string all_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& sentence : sentences) text.append(text.empty() ? "" : " ").append(sentence);
  return text;
}

constexpr std::array<const char*, 5> names_of_fits{"unknown", "model", "other-table", "doubtful", "elongated"};

void add_beside_axis(const BesideAxis& b, Row& row) {
  for (const auto& [name, value] :
       {std::pair("pos_y_rms_um", b.spread_um), std::pair("sine_mode_2_per_um", b.sine_slope.value),
        std::pair("sine_mode_2_per_um_error", b.sine_slope.error), std::pair("flank_slope_per_um", b.flank_slope.value),
        std::pair("flank_slope_per_um_error", b.flank_slope.error),
        std::pair("flank_slope_per_um_change", b.flank_change().value),
        std::pair("flank_slope_per_um_stored", b.stored_slope), std::pair("pos_y_rms_change_per_um", b.centring.value),
        std::pair("pos_y_rms_change_per_um_error", b.centring.error)})
    row[name] = number_text(value);
  const std::string turn = b.turn_text(), centring = b.centring_text();
  row["beside_axis_text"] = turn + (turn.empty() || centring.empty() ? "" : " ") + centring;
}

void add_shapes(const ShapeVerdict& v, Row& row) {
  for (const auto& [name, value] :
       {std::pair("young_modulus_elongated_median_kPa", v.elongated_kPa.median),
        std::pair("young_modulus_elongated_first_quartile_kPa", v.elongated_kPa.first_quartile),
        std::pair("young_modulus_elongated_third_quartile_kPa", v.elongated_kPa.third_quartile),
        std::pair("deformation_over_elongated_modulus", v.modulus_ratio),
        std::pair("elongation_median", v.elongation.value),
        std::pair("elongation_median_error", v.elongation.error),
        std::pair("axial_tension_median_Pa", v.axial_tension_Pa.value),
        std::pair("axial_tension_median_error_Pa", v.axial_tension_Pa.error),
        std::pair("mode_4_beyond_solids", v.cortex_mode_4.value),
        std::pair("mode_5_beyond_solids", v.cortex_mode_5.value),
        std::pair("modulus_over_that_of_fitting_table", v.other.modulus_over_its),
        std::pair("shape_excess_median", v.excess.value),
        std::pair("shape_excess_median_error", v.excess.error),
        std::pair("inertia_ratio_median", v.inertia_ratio),
        std::pair("inertia_ratio_expected", v.expected_inertia_ratio),
        std::pair("elongated_percent", v.elongated_percent()),
        std::pair("odd_share_median", v.odd_share),
        std::pair("inertia_ratio_change", v.inertia_ratio_trend.change),
        std::pair("deformation_change", v.deformation_trend.change),
        std::pair("deformation_change_error", v.deformation_trend.error),
        std::pair("mode_3_change", v.asymmetry_trend.change)})
    row[name] = number_text(value);
  add_beside_axis(v.beside_axis, row);
  row["with_elongation"] = std::to_string(v.with_elongation);
  if (v.with_elongation > 0) row["elongated_by"] = v.elongated_by == ElongatedBy::modes ? "outlines" : "inertia ratio";
  row["red_cells"] = std::to_string(v.red_cells);
  constexpr std::array<const char*, 3> recommended{"none", "deformation", "elongated"};
  row["recommended_modulus"] = recommended.at(static_cast<std::size_t>(v.recommended()));
  row["recommended_young_modulus_median_kPa"] =
      number_text(v.recommended() == ShapeVerdict::Modulus::elongated        ? v.elongated_kPa.median
                  : v.recommended() == ShapeVerdict::Modulus::by_deformation ? v.by_deformation_kPa
                                                                             : no_value);
  row["recommended_text"] = v.recommended_text();
  row["shapes"] = names_of_fits.at(static_cast<std::size_t>(v.fit()));
  row["shapes_of_model"] = v.model;
  row["fitting_table"] = v.other.identifier;
  row["shapes_text"] = v.text();
  row["trend_text"] = v.trend_text();
}

Row row_of(const SummaryLine& line) {
  Row row{{"recording", line.recording.string()}};
  if (!line.error.empty()) {
    row["remarks"] = line.error;
    return row;
  }
  const ExtractSummary& s = line.summary;
  row["events"] = std::to_string(s.events);
  for (std::size_t k = 0; k < states_by_deformation().size(); ++k)
    row[column_of(states_by_deformation()[k])] = std::to_string(s.counts[k]);
  const auto events = static_cast<double>(std::max<std::size_t>(s.events, 1));
  const auto& d = s.modulus_kPa;
  const auto& c = s.conditions;
  for (const auto& [name, value] :
       {std::pair("with_modulus_percent", 100 * static_cast<double>(s.with_modulus()) / events),
        std::pair("young_modulus_median_kPa", d.median),
        std::pair("young_modulus_first_quartile_kPa", d.first_quartile),
        std::pair("young_modulus_third_quartile_kPa", d.third_quartile), std::pair("young_modulus_mean_kPa", d.mean),
        std::pair("young_modulus_standard_deviation_kPa", d.standard_deviation),
        std::pair("young_modulus_standard_error_median_kPa", s.median_standard_error_kPa),
        std::pair("mean_viscosity_mPas", s.mean_viscosity_mPas), std::pair("channel_width_um", c.flow.width_um),
        std::pair("flow_rate_ul_s", c.flow.rate_ul_s), std::pair("pixelation_pixel_size_um", c.pixel_size_um)})
    row[name] = number_text(value);
  add_shapes(s.shapes, row);
  row.insert({{"table", s.table},
              {"medium", s.medium},
              {"viscosity_model", s.viscosity_model},
              {"temperature", s.temperature},
              {"corrected_for_pixels", s.corrected},
              {"gates", s.gates},
              {"area_from", s.area_from},
              {"deformation_from", s.deformation_from},
              {"sample", s.labels.sample},
              {"date", s.labels.date},
              {"time", s.labels.time},
              {"run_index", s.labels.run_index},
              {"chip", s.labels.chip},
              {"remarks", all_of(s.warnings)}});
  return row;
}

std::vector<Row> rows_in(std::string_view text) {
  std::vector<Row> rows;
  const auto lines = split(text, '\n');
  const auto names = split(lines.front(), '\t');
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const auto cells = split(lines[k], '\t');
    if (cells.size() != names.size()) continue;  // the end of the text
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

std::string content_of(const fs::path& path) {
  constexpr std::size_t enough = std::size_t{64} << 20U;
  return first_bytes(path, enough).value_or("");
}

fs::path name_in_summary(const fs::path& recording, const fs::path& folder) {
  std::error_code error;
  const fs::path full = fs::weakly_canonical(fs::absolute(recording).parent_path(), error) / recording.filename();
  const fs::path relative = full.lexically_relative(folder);
  return relative.empty() || *relative.begin() == ".." ? full : relative;
}

}  // namespace

std::string summary_table(std::span<const SummaryLine> lines, std::string_view earlier) {
  std::map<std::string, Row> by_recording;
  for (auto& row : rows_in(earlier)) by_recording[row["recording"]] = std::move(row);
  for (const auto& line : lines) by_recording[cell(line.recording.string())] = row_of(line);
  const auto names = columns();
  std::string text;
  for (const auto& name : names) text.append(text.empty() ? "" : "\t").append(name);
  for (auto& [recording, row] : by_recording) {
    text.append("\n").append(recording);
    for (std::size_t i = 1; i < names.size(); ++i) text.append("\t").append(cell(row[names[i]]));
  }
  return text + "\n";
}

void check_place_of_summary(const fs::path& file) { check_replaceable(file, mark, Foreign::keep); }

void add_to_summary(const fs::path& file, std::span<const SummaryLine> lines) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(file).parent_path(), error);
  fs::create_directories(folder, error);
  std::vector<SummaryLine> named(lines.begin(), lines.end());
  for (auto& line : named) line.recording = name_in_summary(line.recording, folder);
  const Claim alone = wait_for_folder(folder);
  check_place_of_summary(file);
  write_own_file(file, summary_table(named, content_of(file)), mark, Foreign::keep);
}

}  // namespace rheocyte
