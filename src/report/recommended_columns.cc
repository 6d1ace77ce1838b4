#include "report/recommended_columns.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "extract/recommendation.h"
#include "extract/shape_words.h"
#include "report/rows_json.h"

namespace rheocyte {

namespace {

using S = ExtractSummary;
using R = Recommendation;

std::string_view way_word(const R& r) {
  constexpr std::array<std::string_view, 4> words{"none", "deformation", "elongated", "effective"};
  return words.at(static_cast<std::size_t>(r.way));
}

Columns<R> recommendation_columns() {
  ColumnList<R> list;
  list.add({"modulus", "", "Recommended modulus", "\"none\", \"deformation\", \"elongated\" or \"effective\""},
           way_word)
      .add_with_errors(
          {"young_modulus_median_kPa", "kPa", "Recommended E, median", "the modulus that is to be reported", "", 0,
           digits_of_values},
          [](const R& r) { return r.kPa.value; }, [](const R& r) { return r.kPa.error; },
          [](const R& r) { return r.kPa.common_error; })
      .add({"reason", "", "Reason", "why this number, or why none"}, [](const R& r) { return code_of(r.reason); })
      .add({"bound", "", "Bound", "\"softer\" or \"stiffer\", of a median beyond the table"}, &R::bound)
      .add({"bound_kPa", "kPa", "Bound of the recommended E", "than which the median is softer or stiffer"},
           &R::bound_kPa)
      .add({"share_percent", "%", "Events with the recommended modulus", "of those that were judged"},
           [](const R& r) { return 100 * r.events.share(); });
  return std::move(list).columns();
}

}  // namespace

const Columns<S>& recommended_columns() {
  static const Columns<S> columns = [] {
    ColumnList<S> list;
    list.add_of(recommendation_columns(), [](const S& s) { return recommendation(s.shapes); });
    list.add({"text", "", "Recommendation in a sentence", "with the errors and the reason"},
             [](const S& s) { return recommendation_text(recommendation(s.shapes), s.shapes); });
    return std::move(list).columns();
  }();
  return columns;
}

nlohmann::ordered_json recommended_json(const S& summary) { return printed_row_json(recommended_columns(), summary); }

std::string recommended_in_short(const S& summary) {
  constexpr int digits = 3;
  const R r = recommendation(summary.shapes);
  if (std::isfinite(r.bound_kPa))
    return fmt::format("recommended: {} than {:.{}g} kPa", r.bound(), r.bound_kPa, digits);
  if (!std::isfinite(r.kPa.value)) return "no modulus is recommended";
  return fmt::format("recommended: E = {} kPa", text_with_errors(r.kPa, digits));
}

std::vector<std::string> recommended_lines(const S& summary) {
  std::vector<std::string> lines;
  for (const auto& column : recommended_columns())
    if (const CellValue value = column.value(summary); has_value(value))
      lines.push_back(fmt::format("{}{}: {}", start_of_recommended, column.name, cell_text(column, value)));
  return lines;
}

}  // namespace rheocyte
