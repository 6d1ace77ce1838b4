// A combined table in another liquid: against a table computed in it, and against direct states of cells with other
// proportions of bulk, cortex and tension.
#include "infer/liquid_change.h"

#include <gtest/gtest.h>

#include <cmath>

#include "infer/bulk_cortex_fit.h"
#include "table/combined_table.h"

namespace rheocyte::liquid_change_test {
namespace {

CombinedTable shipped(const std::string& identifier) {
  return read_combined_table(std::filesystem::path(SHIPPED_TABLES) / combined_file_name(identifier));
}

const CombinedTable& hl60_cells() {
  static const CombinedTable table = shipped("HL-2D-NH-26");
  return table;
}
const CombinedInterpolation& newtonian() {
  static const CombinedInterpolation table(hl60_cells());
  return table;
}
const CombinedTable& all_cells() {
  static const CombinedTable table = shipped("HC-2D-NH-26");
  return table;
}

TEST(LiquidChange, CellsOfTheSameProportionsAreThoseOfTheTableOfTheLiquid) {
  const CombinedInterpolation cellcarrier(shipped("HL-2D-NH-MC049-26"));
  const CombinedTable made = LiquidChange(newtonian(), cellcarrier).changed(hl60_cells());
  const CombinedInterpolation changed(made);
  EXPECT_EQ(channel_flow_of(changed.spec().base).exponent, 0.6548);
  int cells = 0;
  CellCoordinates cell = newtonian().box().least;
  for (const double radius_um : {4.2, 5.5, 6.8})
    for (const double progress : {-3.4, -2.6, -2.0})
      for (const double axial : {-0.05, 0.3, 1.1, 2.0}) {
        cell(x_radius) = std::log(radius_um), cell(x_progress) = progress, cell(x_axial) = axial;
        if (!newtonian().is_inside(cell) || !cellcarrier.is_inside(cell) || !changed.is_inside(cell)) continue;
        const CombinedState state = changed.at(cell), expected = cellcarrier.at(cell);
        EXPECT_LT((state.value - expected.value).cwiseAbs().maxCoeff(), 1e-3) << cell.transpose();
        EXPECT_LT((state.gradient - expected.gradient).col(x_progress).cwiseAbs().maxCoeff(), 5e-3) << cell.transpose();
        ++cells;
      }
  EXPECT_GT(cells, 20);
}

/// A cell of 5.9 um in the tube of a channel of 20 um at 0.04 ul/s, solved in the liquid (3e4 kBT, accuracy 1e-2).
struct DirectState {
  double fraction, tension_ratio, axial_ratio, stiffness_kPa;
  double area_um2, deformation;
  std::array<double, 6> modes;  ///< from the second on
};

struct PowerLaw {
  std::string name;
  double consistency, exponent;
  std::vector<DirectState> states;
};

const std::vector<PowerLaw> liquids{
    {"HL-2D-NH-MC049-26",
     0.2079,
     0.6548,
     {{0.35, 0.8, 0.2, 0.212746, 113.75152, 0.070527, {0.038120, 0.162109, -0.042479, 0.022758, 0.030190, -0.022442}},
      {0.35, 0.8, 0.9, 0.159559, 126.76101, 0.089973, {0.226954, 0.125094, -0.010410, 0.077505, -0.004860, 0.015065}},
      {0.5, 0.3, 0.2, 0.240871, 122.66057, 0.078753, {0.051948, 0.158623, -0.048383, 0.028280, 0.027636, -0.025634}}}},
    {"HL-2D-NH-MC083-26",
     1.4936,
     0.5149,
     {{0.35, 0.8, 0.2, 0.348426, 112.91468, 0.069026, {0.023252, 0.161738, -0.040848, 0.018245, 0.031758, -0.022254}},
      {0.35, 0.8, 0.9, 0.261320, 125.77904, 0.085661, {0.206840, 0.127415, -0.015615, 0.073593, -0.003046, 0.011171}},
      {0.5, 0.3, 0.2, 0.394489, 121.81440, 0.077208, {0.037678, 0.158858, -0.046782, 0.023826, 0.029616, -0.025501}}}}};

/// By area and modes 2 to 7 under a known tension, over that of the state.
double found_over_true(const CombinedTable& table, const PowerLaw& liquid, const DirectState& state) {
  const CombinedInterpolation between(table);
  const BulkCortexFit fit(between, channel_flow_of(table.spec.base), {features_of_contour(7), true, 0});
  const double shear_rate = 8 * 0.04e-9 / 8e-15 * (0.6671 + 0.2121 / liquid.exponent);
  const ChannelFlow flow{20, 0.04, 1e3 * liquid.consistency * std::pow(shear_rate, liquid.exponent - 1),
                         liquid.exponent};
  MeasuredShape shape{ShapeVector::Zero(), {}};
  shape.features(int(ShapeFeature::area_um2)) = std::log(state.area_um2);
  shape.features(int(ShapeFeature::deformation)) = state.deformation;
  for (int k = 0; k < int(state.modes.size()); ++k)
    shape.features(feature_of_mode(2 + k)) = state.modes[std::size_t(k)];
  shape.errors.covariance = 1e-7 * decltype(shape.errors.covariance)::Identity();
  const double tension_Pa = 1e3 * state.axial_ratio * state.stiffness_kPa;
  const ModuliEstimate found = fit.fit(shape, flow, {tension_Pa, 0});
  const CellsAtRest at_rest = fit.at_rest().scaled(scale_factors(fit.simulated(), flow));
  return found.effective_modulus_kPa /
         (state.stiffness_kPa *
          effective_modulus_over_stiffness<double>(
              at_rest, {std::log(5.9), std::log(state.stiffness_kPa), state.fraction, state.tension_ratio}));
}

TEST(LiquidChange, CellsOfOtherProportionsHaveTheEffectiveModulusOfDirectStates) {
  for (const PowerLaw& liquid : liquids) {
    const CombinedInterpolation requested(shipped(liquid.name));
    const CombinedTable changed = LiquidChange(newtonian(), requested).changed(all_cells());
    for (const DirectState& state : liquid.states) {
      EXPECT_NEAR(found_over_true(changed, liquid, state), 1, 0.07) << liquid.name << " " << state.deformation;
      EXPECT_GT(std::abs(found_over_true(all_cells(), liquid, state) - 1), 0.15)
          << "in a Newtonian liquid of the same viscosity at the wall";
    }
  }
}

}  // namespace
}  // namespace rheocyte::liquid_change_test
