#include "report/moduli_summary_columns.h"

#include <fmt/format.h>

#include <cmath>

#include "report/distribution_columns.h"

namespace rheocyte {

namespace {

/// And the 90 % interval of the median by the law of the cells.
void add_quartiles_and_interval(ColumnList<ModuliSummary>& list, const DistributedQuantity& quantity,
                                Distribution ModuliSummary::*of, NumberOfLaw LawOfCells::*by_law) {
  add_quartiles(list, quantity, [of](const ModuliSummary& s) { return s.*of; });
  const std::string median = quantity.column("median", "median").name;
  list.add({median + "_low", quantity.unit, "", "lower end of its 90 % interval, by the population"},
           [by_law](const ModuliSummary& s) { return median_interval(s.axial.law.*by_law).first; })
      .add({median + "_high", quantity.unit, "", "upper end of it"},
           [by_law](const ModuliSummary& s) { return median_interval(s.axial.law.*by_law).second; });
}

}  // namespace

Columns<ModuliSummary> moduli_summary_columns() {
  using S = ModuliSummary;
  ColumnList<S> list;
  list.add({"outline_noise_um", "um", "Errors of the outline", "in addition to those of the pixels, as given"},
           &S::outline_noise_um)
      .add({"gates", "", "Gates", "limits and polygons of the events that count"}, &S::gates)
      .add({"settings_hash", "", "Hash of the settings", "the same for results that are comparable"},
           &S::settings_hash);
  add_quartiles(list, {"young_modulus", "kPa", "kPa", "E of the bulk", "Young's modulus of the resolved events"},
                [](const S& s) { return s.young_kPa; });
  add_quartiles(
      list, {"cortex_modulus", "mN_per_m", "mN/m", "Cortex modulus E2D", "the cortex modulus of the resolved events"},
      [](const S& s) { return s.cortex_mN_per_m; });
  add_quartiles_and_interval(list,
                             {"stiffness", "kPa", "kPa", "Stiffness E + E2D/r0",
                              "the stiffness of the population; without one, of all events that have one"},
                             &S::stiffness_kPa, &LawOfCells::stiffness);
  add_quartiles_and_interval(list,
                             {"effective_modulus", "kPa", "kPa", "Effective Young's modulus",
                              "the Young's modulus of solids that a small tension elongates as much; of the "
                              "population, else of all events that have one"},
                             &S::effective_modulus_kPa, &LawOfCells::effective_modulus);
  list.add_with_interval(
          {"axial_tension_Pa", "Pa", "Axial tension of the liquid",
           "along the flow, that all cells have in common, with the 90 % interval"},
          [](const S& s) { return s.axial.has_tension() ? s.axial.law.axial_tension.value_Pa : no_value; },
          [](const S& s) { return tension_interval_Pa(s.axial.law.axial_tension).first; },
          [](const S& s) { return tension_interval_Pa(s.axial.law.axial_tension).second; })
      .add({"axial_tension_is_given", "", "Axial tension given", "by the user"},
           [](const S& s) { return s.axial.is_given; })
      .add_count("axial_tension_cells", [](const S& s) { return s.axial.law.cells; })
      .add({"axial_tension_chi_squared_per_freedom", "", "Chi squared per degree of freedom",
            "of the mean features of the cells"},
           [](const S& s) { return s.axial.law.misfit; })
      .add({"wall_shear_stress_Pa", "Pa", "Shear stress of the wall", "median over the cells"},
           [](const S& s) { return s.axial.wall_stress_Pa; });
  return std::move(list).columns();
}

Columns<MedianCell> median_cell_columns() {
  using M = MedianCell;
  ColumnList<M> list;
  list.add_count("cells", &M::cells)
      .add({"status", "", "Status", "of the fit"}, [](const M& m) { return name_of(m.status); })
      .add_with_error({"young_modulus_kPa", "kPa", "E of the bulk", "Young's modulus"}, &M::young_kPa,
                      &M::young_error_kPa)
      .add_with_error({"cortex_modulus_mN_per_m", "mN/m", "Cortex modulus E2D", "of the median cell"},
                      &M::cortex_mN_per_m, &M::cortex_error_mN_per_m)
      .add_with_error({"tension_mN_per_m", "mN/m", "Cortex tension", "of the median cell"}, &M::tension_mN_per_m,
                      &M::tension_error_mN_per_m)
      .add_with_error({"stiffness_kPa", "kPa", "Stiffness E + E2D/r0", "of the median cell"}, &M::stiffness_kPa,
                      &M::stiffness_error_kPa)
      .add_with_error({"effective_modulus_kPa", "kPa", "Effective Young's modulus", "of the median cell"},
                      &M::effective_modulus_kPa, &M::effective_modulus_error_kPa)
      .add_with_error({"axial_tension_Pa", "Pa", "Axial tension of the liquid", "from the median cell only"},
                      &M::axial_tension_Pa, &M::axial_tension_error_Pa)
      .add({"chi_squared", "", "Chi squared", "distance of the features, in units of their errors"}, &M::chi_squared)
      .add_count("degrees_of_freedom", &M::freedom)
      .add({"at_end_of_table", "", "At the end of the table", "beyond which other cells may fit better"},
           &M::is_at_end);
  return std::move(list).columns();
}

std::vector<FeatureOfMedian> features_of(const MedianCell& m) {
  const double area = std::exp(m.measured[0]);
  std::vector<FeatureOfMedian> features{{"area_um2", area, area * m.error[0], std::exp(m.fitted[0])},
                                        {"deformation", m.measured[1], m.error[1], m.fitted[1]}};
  for (int k = min_mode; k <= max_mode; ++k) {
    const auto f = std::size_t(int(ShapeFeature::first_mode) + k - min_mode);
    features.push_back({fmt::format("c{}", k), m.measured[f], m.error[f], m.fitted[f]});
  }
  return features;
}

Columns<FeatureOfMedian> feature_of_median_columns() {
  using F = FeatureOfMedian;
  ColumnList<F> list;
  list.add({"name", "", "Feature", "area_um2, deformation or a mode of the outline"}, &F::name)
      .add_with_error({"measured", "", "Measured", "median of the cells, without what pixels add"}, &F::measured,
                      &F::error)
      .add({"fitted", "", "Fitted", "of the cell of the table"}, &F::fitted);
  return std::move(list).columns();
}

std::vector<SlopeBetweenCells> slopes_of(const AxialSummary& s) {
  std::vector<SlopeBetweenCells> slopes;
  if (!s.is_of_elongated_cells || std::isnan(s.measured.value[0])) return slopes;
  for (std::size_t k = 0; k < slope_count; ++k)
    slopes.push_back({fmt::format("dc{}/dc2", k + 3), s.measured.value[k], s.measured.error[k],
                      s.predicted.by_stiffness[k], s.predicted.by_fraction[k], s.predicted.by_ratio[k],
                      s.predicted.by_axial_tension[k]});
  return slopes;
}

Columns<SlopeBetweenCells> slope_columns() {
  using S = SlopeBetweenCells;
  ColumnList<S> list;
  list.add({"name", "", "Slope", "dc3/dc2, dc4/dc2 or dc5/dc2, between cells at equal area"}, &S::name)
      .add_with_error({"slope", "", "Measured slope", "between the cells"}, &S::value, &S::error)
      .add({"by_stiffness", "", "Slope by the stiffness", "of cells that differ only in it"}, &S::by_stiffness)
      .add({"by_cortex_fraction", "", "Slope by the fraction of the cortex",
            "of cells that differ only in this fraction"},
           &S::by_cortex_fraction)
      .add({"by_tension_ratio", "", "Slope by the tension of the cortex",
            "of cells that differ only in this tension over the modulus of the cortex"},
           &S::by_tension_ratio)
      .add({"by_axial_tension", "", "Slope by the axial tension", "of cells that differ only in this tension"},
           &S::by_axial_tension);
  return std::move(list).columns();
}

}  // namespace rheocyte
