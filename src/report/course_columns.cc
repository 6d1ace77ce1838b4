#include "report/course_columns.h"

#include <utility>

namespace rheocyte {

const Columns<CourseRow>& course_columns() {
  using R = CourseRow;
  static const Columns<R> columns = [] {
    ColumnList<R> list;
    const auto add = [&list](const char* name, auto value, int digits) {
      list.add({.name = name, .digits = digits}, value);
    };
    const auto add_credible = [&list](ColumnDescription about, Credible R::*of) {
      about.digits = 5;
      const auto end = [of](double Credible::*which) { return [=](const R& row) { return row.*of.*which; }; };
      list.add_with_interval(about, end(&Credible::value), end(&Credible::low), end(&Credible::high));
    };
    list.add({"recording"}, &R::recording);
    list.add_count("cell", &R::cell);
    list.add_count("events", &R::events);
    add("first_place_um", &R::first_place_um, 4);
    add("last_place_um", &R::last_place_um, 4);
    add("radius_um", &R::radius_um, 4);
    add_credible({.name = "young_modulus_kPa", .unit = "kPa"}, &R::young_modulus_kPa);
    add_credible({.name = "viscosity_Pas", .unit = "Pa s"}, &R::viscosity_Pas);
    add("chi_squared", &R::chi_squared, 3);
    add("section_factor", &R::section_factor, 4);
    add("section_error", &R::section_error, 2);
    add(
        "mode_2_excess", [](const R& row) { return row.drawn_out.mode_2_excess; }, 3);
    add(
        "tension_factor", [](const R& row) { return row.drawn_out.factor; }, 4);
    list.add({"status"}, &R::status);
    list.add({"event_numbers"}, &R::event_numbers);
    return std::move(list).columns();
  }();
  return columns;
}

}  // namespace rheocyte
