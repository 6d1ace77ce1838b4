#include "report/plan_columns.h"

#include <limits>

namespace rheocyte {

const Columns<PlannedChannel>& plan_columns() {
  using C = PlannedChannel;
  static const Columns<C> columns = [] {
    ColumnList<C> list;
    const auto add = [&list](ColumnDescription about, auto value) {
      about.digits = digits_of_errors;
      list.add(about, value);
    };
    list.add({.name = "channel_width_um", .unit = "um"}, [](const C& c) { return c.flow.width_um; });
    list.add({.name = "medium"}, &C::medium);
    list.add({.name = "flow_rate_ul_per_s", .unit = "ul/s", .digits = 4}, [](const C& c) { return c.flow.rate_ul_s; });
    add({.name = "speed_m_per_s", .unit = "m/s", .sentence = "mean speed of the liquid"}, &C::speed_m_s);
    add({.name = "viscosity_mPas", .unit = "mPa s"}, [](const C& c) { return c.flow.viscosity_mPas; });
    add({.name = "wall_stress_Pa", .unit = "Pa", .sentence = "shear stress at the wall without a cell"},
        &C::wall_stress_Pa);
    add({.name = "reynolds_number"}, &C::reynolds_number);
    add({.name = "deformation", .sentence = "of the median cell"}, &C::deformation);
    add({.name = "mode_3", .sentence = "of the median cell"}, &C::mode_3);
    add({.name = "inside_fraction", .sentence = "of the cells, which the table has"}, &C::inside);
    add({.name = "young_modulus_ln_by_asymmetry_error", .sentence = "standard error of ln E by one image"},
        &C::error_by_asymmetry);
    add({.name = "young_modulus_ln_by_deformation_error", .sentence = "standard error of ln E by one image"},
        &C::error_by_deformation);
    list.add({.name = "recommended", .is_flag = true}, &C::is_recommended);
    list.add({.name = "sessions",
              .sentence = "for the requested power; inf: more than 100, nan: the channel does not show the cells",
              .digits = digits_of_counts},
             [](const C& c) {
               if (c.sessions > 0) return double(c.sessions);
               return c.shows_the_cells() ? std::numeric_limits<double>::infinity() : no_value;
             });
    return std::move(list).columns();
  }();
  return columns;
}

}  // namespace rheocyte
