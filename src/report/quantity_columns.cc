#include "report/quantity_columns.h"

#include <fmt/format.h>

#include <cmath>

#include "report/population_columns.h"

namespace rheocyte {
namespace {

std::string median_name(const QuantityWords& words) { return fmt::format("{}_median_{}", words.name, words.suffix); }

/// What recordings and conditions have in common; `log_median` is an interval of ln of the median.
template <class Row, class LogMedian>
ColumnList<Row> quantity_list(PopulationQuantity quantity, const LogMedian& log_median) {
  const QuantityWords words = words_of(quantity);
  const std::string name(words.name), symbol(words.symbol);
  const auto end = [&log_median](double IntervalEstimate::*of) {
    return [log_median, of](const Row& row) { return std::exp(log_median(row).*of); };
  };
  ColumnList<Row> list;
  list.add_with_interval({.name = median_name(words), .unit = words.unit, .label = symbol, .sentence = "of the cells"},
                         end(&IntervalEstimate::value), end(&IntervalEstimate::lower), end(&IntervalEstimate::upper));
  if (quantity != PopulationQuantity::axial_tension)  // one number for all cells
    list.add({.name = fmt::format("{}_mean_{}", name, words.suffix), .unit = words.unit, .sentence = "of the cells"},
             [log_median](const Row& row) { return std::exp(log_median(row).value + row.spread * row.spread / 2); });
  list.add({.name = name + "_ln_spread", .sentence = "standard deviation of the logarithm between cells"},
           &Row::spread);
  return list;
}

}  // namespace

std::string_view interval_words(bool is_by_recordings) {
  return is_by_recordings ? "scatter of the recordings" : "sampling of the events";
}

Columns<QuantityEstimate> columns_of_recordings(PopulationQuantity quantity, double level) {
  using E = QuantityEstimate;
  auto list = quantity_list<E>(quantity, [level](const E& e) -> IntervalEstimate {
    const ParameterInterval ends =
        e.log_interval.value_or(normal_interval(e.mean.value, std::sqrt(e.mean.variance), level));
    return {e.mean.value, ends.lower, ends.upper};
  });
  const std::string log_name = std::string(words_of(quantity).name) + "_ln_median";
  list.add_with_error(
      {.name = log_name, .sentence = "natural logarithm of the median in its unit"},
      [](const E& e) { return e.mean.value; }, [](const E& e) { return std::sqrt(e.mean.variance); });
  list.add({.name = log_name + "_common_error", .sentence = "standard error that recordings of one set-up share"},
           [](const E& e) { return e.common_error > 0 ? e.common_error : no_value; });
  return std::move(list).columns();
}

Columns<ConditionQuantity> columns_of_conditions(PopulationQuantity quantity) {
  using Q = ConditionQuantity;
  const std::string name(words_of(quantity).name);
  auto list = quantity_list<Q>(quantity, [](const Q& q) { return q.log_mean; });
  const auto power = [](double Stiffening::*of) {
    return [of](const Q& q) { return q.stiffening ? (*q.stiffening).*of : no_value; };
  };
  list.add({.name = name + "_interval_by"}, [](const Q& q) { return interval_words(q.is_by_recordings); });
  list.add_with_interval(
      {.name = name + "_ln_scatter",
       .sentence = "standard deviation of ln of the medians between "
                   "recordings, beyond their sampling errors"},
      [](const Q& q) { return q.between.deviation; }, [](const Q& q) { return q.between.lower; },
      [](const Q& q) { return q.between.upper; });
  list.add_with_interval({.name = name + "_stress_exponent", .sentence = "of the quantity as a power of the stress"},
                         power(&Stiffening::exponent), power(&Stiffening::lower), power(&Stiffening::upper));
  list.add({.name = name + "_stress_exponent_degrees_of_freedom"}, power(&Stiffening::freedom));
  return std::move(list).columns();
}

const Columns<PopulationQuantity>& quantity_columns() {
  using Q = PopulationQuantity;
  static const Columns<Q> columns = [] {
    ColumnList<Q> list;
    list.add({.name = "quantity"}, [](Q q) { return words_of(q).name; });
    list.add({.name = "median", .sentence = "the column of the median"}, [](Q q) { return median_name(words_of(q)); });
    list.add({.name = "symbol"}, [](Q q) { return words_of(q).symbol; });
    list.add({.name = "unit"}, [](Q q) { return words_of(q).unit; });
    return std::move(list).columns();
  }();
  return columns;
}

}  // namespace rheocyte
