#include "table/combined_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "case/joined.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "numeric/number_from_chars.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

constexpr int leading_columns = 8;  // before the features, without the next one
constexpr int axial_column = 3;     // of elongated cells, between the others

std::vector<std::string> column_names(const TableSpec& spec) {
  std::vector<std::string> names{"radius_um",        "cortex_fraction",   "tension_ratio",
                                 "stiffness_kPa",    "young_modulus_kPa", "cortex_modulus_mN_per_m",
                                 "tension_mN_per_m", "deformation_error"};
  if (spec.is_elongated()) names.insert(names.begin() + axial_column, "axial_ratio");
  for (const auto& name : feature_names()) names.push_back(name);
  for (const auto& name : feature_names()) names.push_back("slope_" + name);
  return names;
}

Eigen::VectorXd modes_of(const Eigen::MatrixX2d& meridian) {
  const auto modes = outline_shape(mirrored(meridian)).modes;
  return Eigen::Map<const Eigen::VectorXd>(modes.data(), mode_count);
}

CombinedBranch combined_branch(const SampledBranch& branch) {
  constexpr double step = 1e-4;  // in ln S; the hull's corners make differences over smaller steps no better
  const int n = branch.samples();
  CombinedBranch combined{{branch.radius_um, branch.cortex_fraction, branch.tension_ratio, branch.axial_ratio},
                          branch.stiffness,
                          Eigen::MatrixXd(n, feature_count),
                          Eigen::MatrixXd(n, feature_count),
                          branch.error};
  for (const auto& [feature, measure] : {std::pair(ShapeFeature::area_um2, Measure::area_um2),
                                         std::pair(ShapeFeature::deformation, Measure::deformation),
                                         std::pair(ShapeFeature::moment_ratio, Measure::moment_ratio)}) {
    combined.value.col(int(feature)) = branch.value.col(int(measure));
    combined.slope.col(int(feature)) = branch.slope.col(int(measure));
  }
  for (int i = 0; i < n; ++i) {
    const auto& contour = branch.contour[std::size_t(i)];
    const Eigen::MatrixX2d move = step * branch.contour_slope[std::size_t(i)];
    combined.value.row(i).tail(mode_count) = modes_of(contour).transpose();
    combined.slope.row(i).tail(mode_count) =
        (modes_of(contour + move) - modes_of(contour - move)).transpose() / (2 * step);
  }
  return combined;
}

std::string row_text(const TableSpec& spec, const CombinedBranch& branch, int i) {
  const auto& [radius, fraction, ratio, axial] = branch.place;
  const double S = branch.stiffness_kPa[std::size_t(i)], cortex = fraction * S * radius;
  std::vector<double> numbers{
      radius, fraction, ratio, S, (1 - fraction) * S, cortex, ratio * cortex, branch.error[std::size_t(i)]};
  if (spec.is_elongated()) numbers.insert(numbers.begin() + axial_column, axial);
  for (const auto* matrix : {&branch.value, &branch.slope})
    for (int f = 0; f < feature_count; ++f) numbers.push_back((*matrix)(i, f));
  return fmt::format("{}\n", joined(numbers, ","));
}

/// Far wider than what cells have.
bool are_of_a_cell(const Eigen::VectorXd& features) {
  return features.allFinite() && features(int(ShapeFeature::area_um2)) > 0 &&
         features(int(ShapeFeature::deformation)) > 0 && features(int(ShapeFeature::deformation)) < 1 &&
         features(int(ShapeFeature::moment_ratio)) > 0 && features.tail(mode_count).cwiseAbs().maxCoeff() < 1;
}

std::string_view why_no_state(const CombinedBranch& branch, int i, const Eigen::VectorXd& features) {
  const auto& [radius, fraction, ratio, axial] = branch.place;
  const auto at = std::size_t(i);
  const double S = branch.stiffness_kPa[at];
  if (!(radius > 0 && S > 0 && features(int(ShapeFeature::deformation)) > 0))
    return "radius, stiffness and deformation are not positive";
  if (!(fraction >= 0 && fraction <= 1 && ratio >= 0 && std::isfinite(axial) && branch.error[at] >= 0 &&
        are_of_a_cell(features)))
    return "the numbers are not those of a cell";
  if (i > 0 && S >= branch.stiffness_kPa[at - 1]) return "the stiffness does not fall along the branch";
  return {};
}

/// E, E2D and tension are in the file for its readers; they follow from the other columns (eq:combined).
bool has_its_moduli(const std::vector<double>& row) {
  const double S = row[3], cortex = row[1] * S * row[0];
  const auto is_same = [&](double one, double other, double scale) { return std::abs(one - other) <= 1e-9 * scale; };
  return is_same(row[4], (1 - row[1]) * S, S) && is_same(row[5], cortex, S * row[0]) &&
         is_same(row[6], row[2] * cortex, cortex);
}

/// Of this version, or of the one before, which had another word for a fraction.
bool is_header(std::string_view line, std::string_view columns) {
  constexpr std::string_view word = "cortex_fraction", former_word = "cortex_share";
  const auto place = columns.find(word);
  return line == columns || line == std::string(columns).replace(place, word.size(), former_word);
}

// Goes over the lines of a file and keeps the place of errors.
class CombinedReader {
 public:
  CombinedReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  CombinedTable read(const TableSpec& spec) {
    CombinedTable table{spec, {}};
    const auto names = column_names(spec);
    if (!is_header(next(), joined(names, ",")))
      refuse("the columns are not those of a combined table of this version; let `rheocyte table` write it again");
    while (!text_.empty()) {
      auto row = numbers_of(next(), names.size());
      double axial = 0;
      if (spec.is_elongated()) {
        axial = row[axial_column];
        row.erase(row.begin() + axial_column);
      }
      take_row(row, axial, table.branches);
    }
    for (auto& branch : table.branches) finish(branch);
    if (table.branches.empty()) refuse("there are no rows");
    return table;
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw UserError(fmt::format("{}:{}: {}.", name_, line_, reason));
  }

  std::string_view next() {
    const auto end = text_.find('\n');
    const auto line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    ++line_;
    return line;
  }

  std::vector<double> numbers_of(std::string_view line, std::size_t count) const {
    std::vector<double> numbers;
    const char *at = line.data(), *const end = at + line.size();
    while (true) {
      double number = 0;
      const auto [stop, error] = number_from_chars(at, end, number);
      if (error != std::errc{} || !std::isfinite(number)) refuse("there is something else than numbers");
      numbers.push_back(number);
      if (stop == end) break;
      if (*stop != ',') refuse("there is something else than numbers");
      at = stop + 1;
    }
    if (numbers.size() != count) refuse("the row has another number of columns");
    return numbers;
  }

  /// Without the axial ratio, which stands apart.
  void take_row(const std::vector<double>& row, double axial, std::vector<CombinedBranch>& branches) {
    const auto is_of = [&](const SweepPoint& place) {
      return place.radius_um == row[0] && place.cortex_fraction == row[1] && place.tension_ratio == row[2] &&
             place.axial_ratio == axial;
    };
    if (branches.empty() || !is_of(branches.back().place)) {
      branches.push_back({{row[0], row[1], row[2], axial}, {}, {}, {}, {}});
      rows_.emplace_back();
    }
    CombinedBranch& branch = branches.back();
    branch.stiffness_kPa.push_back(row[3]);
    branch.error.push_back(row[leading_columns - 1]);
    rows_.back().insert(rows_.back().end(), row.begin() + leading_columns, row.end());
    if (const auto reason = why_no_state(branch, branch.samples() - 1, features_of(row)); !reason.empty())
      refuse(std::string(reason));
    if (!has_its_moduli(row)) refuse("the moduli are not those of this stiffness, radius, fraction and tension");
  }

  static Eigen::VectorXd features_of(const std::vector<double>& row) {
    return Eigen::Map<const Eigen::VectorXd>(row.data() + leading_columns, feature_count);
  }

  void finish(CombinedBranch& branch) {
    const auto& numbers = rows_[finished_++];
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const RowMajor> all(numbers.data(), branch.samples(), 2 * feature_count);
    branch.value = all.leftCols(feature_count);
    branch.slope = all.rightCols(feature_count);
  }

  std::string_view text_;
  std::string name_;
  int line_ = 0;
  std::vector<std::vector<double>> rows_;  ///< features and slopes of each branch
  std::size_t finished_ = 0;
};

}  // namespace

std::vector<std::string> feature_names() {
  std::vector<std::string> names{"area_um2", "deformation", "moment_ratio"};
  for (int k = min_mode; k <= max_mode; ++k) names.push_back(fmt::format("mode_{}", k));
  return names;
}

CombinedTable make_combined_table(const TableSpec& spec, std::span<const SampledBranch> branches) {
  CombinedTable table{spec, {}};
  for (const auto& branch : branches)
    if (!branch.empty()) table.branches.push_back(combined_branch(branch));
  return table;
}

std::string combined_table_csv(const CombinedTable& table) {
  std::string text = fmt::format("{}\n", joined(column_names(table.spec), ","));
  for (const auto& branch : table.branches)
    for (int i = 0; i < branch.samples(); ++i) text += row_text(table.spec, branch, i);
  return text;
}

std::string combined_ends_csv(const TableSpec& spec, std::span<const SampledBranch> branches) {
  const bool elongated = spec.is_elongated();
  std::string text = fmt::format("radius_um,cortex_fraction,tension_ratio,{}samples,stiffness_kPa,deformation,status\n",
                                 elongated ? "axial_ratio," : "");
  for (const auto& branch : branches) {
    const int last = branch.samples() - 1;
    text += fmt::format("{},{},{},", branch.radius_um, branch.cortex_fraction, branch.tension_ratio);
    if (elongated) text += fmt::format("{},", branch.axial_ratio);
    text += fmt::format("{},", last + 1);
    text += last < 0 ? "," : fmt::format("{},{}", branch.stiffness.back(), branch.at(last, Measure::deformation));
    text += fmt::format(",{}\n", name(branch.end.status));
  }
  return text;
}

std::string combined_table_name(const TableSpec& spec) { return fmt::format("combined_{}.csv", spec.identifier); }

CombinedTable parse_combined_table(const TableSpec& spec, std::string_view csv, const std::string& name) {
  return CombinedReader(csv, name).read(spec);
}

std::string_view why_no_branch(const CombinedBranch& branch) {
  for (int i = 0; i < branch.samples(); ++i)
    if (const auto reason = why_no_state(branch, i, branch.value.row(i)); !reason.empty()) return reason;
  return branch.slope.allFinite() ? std::string_view() : "the numbers are not those of a cell";
}

CombinedTable read_combined_table(const std::filesystem::path& folder) {
  constexpr std::size_t largest = std::size_t{1} << 30U;
  if (folder.extension() == ".cbor")
    return combined_from_bytes(content_of_file(folder, largest), one_line(folder.string(), 300));
  const auto refuse = [&](const std::string& reason) -> void {
    throw UserError(fmt::format("{}: {}", one_line(folder.string(), 300), reason));
  };
  std::error_code error;
  if (!std::filesystem::exists(folder / "spec.toml", error))
    refuse("there is no table of `rheocyte table` (no spec.toml in this folder).");
  const TableSpec spec = read_table_spec(folder / "spec.toml");
  if (!spec.is_combined())
    refuse("its cells differ in one modulus only; several moduli need a table with table.cortex_fraction.");
  const auto path = folder / to_path(combined_table_name(spec));
  if (!std::filesystem::exists(path, error))
    refuse(fmt::format("there is no {}; let `rheocyte table` finish it.", combined_table_name(spec)));
  return parse_combined_table(spec, content_of_file(path, largest), path.string());
}

}  // namespace rheocyte
