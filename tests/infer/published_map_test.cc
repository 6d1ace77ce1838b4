// Young's moduli from a published table are those of dclab, event by event, and missing where dclab has none.
#include "infer/published_map.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "measurement/recording.h"
#include "measurement/reference_files.h"
#include "measurement/shape_source.h"
#include "measurement/viscosity.h"

namespace rheocyte::published_map_test {
namespace {

// Table, formulas and triangulation are the same; what is left is the order of operations, magnified in slivers. dclab
// itself computes viscosities in float32 where the file's temperatures are (3e-7).
constexpr double parity = 1e-6;

const PublishedMap& published(const std::string& name) {
  static std::map<std::string, PublishedMap> tables;
  const auto file = test::reference_folder() / ("lut_" + name + ".txt");
  return tables.try_emplace(name, read_published_table(file)).first->second;
}

double modulus(const PublishedMap& table, const MeasuringConditions& conditions, double area, double deformation,
               double viscosity) {
  double value = 0;
  table.moduli(conditions, {{&area, 1}, {&deformation, 1}, {&viscosity, 1}}, {&value, 1});
  return value;
}

struct Comparison {
  int rows = 0, finite = 0, nan_mismatches = 0;
  double greatest = 0;
  void add(double value, double expected) {
    ++rows;
    nan_mismatches += std::isnan(value) != std::isnan(expected);
    finite += std::isfinite(expected);
    if (std::isfinite(value) && std::isfinite(expected)) greatest = std::max(greatest, std::abs(value / expected - 1));
  }
  void expect_parity(const std::string& what) const {
    std::printf("%s: %d rows, %d finite, %d NaN mismatches, greatest relative difference %.1e\n", what.c_str(), rows,
                finite, nan_mismatches, greatest);
    EXPECT_EQ(nan_mismatches, 0) << what;
    EXPECT_LE(greatest, parity) << what;
  }
};

/// A table of one triangle, in which everything can be followed by hand.
PublishedTable triangle() {
  PublishedTable table;
  table.flow.width_um = 20;
  table.flow.rate_ul_s = 0.04;
  table.flow.viscosity_mPas = 15;
  table.size = {50, 100, 100};
  table.deformation = {0.05, 0.0, 0.1};
  table.modulus_kPa = {1, 2, 3};
  return table;
}

TEST(PublishedMap, ScalesWithFlowViscosityAndWidth) {
  const PublishedMap table(triangle());
  EXPECT_NEAR(modulus(table, {{20, 0.04}, 0}, 75, 0.05, 15), 1.75, 1e-14);
  EXPECT_NEAR(modulus(table, {{20, 0.08}, 0}, 75, 0.05, 5), 1.75 * 2 / 3, 1e-14);
  EXPECT_NEAR(modulus(table, {{40, 0.04}, 0}, 300, 0.05, 15), 1.75 / 8, 1e-14);
}

TEST(PublishedMap, ManyEventsGetWhatEachGetsAlone) {
  const PublishedMap table(triangle());
  std::vector<double> areas, deformations, viscosities;
  for (int i = 0; i < 1300; ++i) {
    areas.push_back(40 + 0.05 * i);
    deformations.push_back(0.1 * (i % 97) / 97);
    viscosities.push_back(4 + 0.001 * i);
  }
  std::vector<double> moduli(areas.size());
  const MeasuringConditions conditions{{20, 0.06}, 0.34};
  table.moduli(conditions, {areas, deformations, viscosities}, moduli);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double alone = modulus(table, conditions, areas[i], deformations[i], viscosities[i]);
    EXPECT_TRUE(moduli[i] == alone || (std::isnan(alone) && std::isnan(moduli[i])) ||
                std::abs(moduli[i] / alone - 1) < 1e-13);
  }
}

TEST(PublishedMap, EachEventOutsideIsToldWhy) {
  const PublishedMap table(triangle());
  const MeasuringConditions conditions{{20, 0.04}, 0};
  const auto state = [&](double area, double deformation) {
    return table.state(conditions, area, deformation, modulus(table, conditions, area, deformation, 15));
  };
  EXPECT_EQ(state(75, 0.05), ModulusState::valid);
  EXPECT_EQ(state(40, 0.05), ModulusState::too_small);
  EXPECT_EQ(state(101, 0.05), ModulusState::too_large);
  EXPECT_EQ(state(75, 0.01), ModulusState::too_stiff);
  EXPECT_EQ(state(75, 0.09), ModulusState::too_soft);
  EXPECT_EQ(state(NAN, 0.05), ModulusState::no_data);
  EXPECT_EQ(state(75, NAN), ModulusState::no_data);
  EXPECT_EQ(table.state(conditions, 75, 0.05, modulus(table, conditions, 75, 0.05, NAN)), ModulusState::no_data);
}

TEST(PublishedMap, MeetsTheValuesInTheTestsOfDclab) {
  RHEOCYTE_NEED_REFERENCE("lut_HE-2D-FEM-22.txt");
  struct Row {
    int y, x;
    double linear, hyperelastic;
  };
  // Areas linspace(0, 250, 100), deformations linspace(0, 0.1, 100); 30 um, 0.16 ul/s, CellCarrier at 23 degC by
  // Herold 2017, no pixelation. LE-2D-FEM-19 as it is now, printed digits.
  const Row rows[] = {{10, 50, 1.18758065134375, 1.2520069112713232},  {50, 50, 0.5527066911133949, 0.6442165714687615},
                      {80, 50, 0.4567858941760323, 0.575373042660183}, {10, 80, 1.57446733196235, 1.638297273096505},
                      {50, 80, 0.735344760124051, 0.8191788744746755}, {80, 80, 0.607365802665274, 0.716695164528623}};
  const double viscosity = Buffer(Medium::methyl_cellulose_049, ViscosityModel::herold_2017).viscosity({30, 0.16}, 23);
  for (const auto& row : rows) {
    const double area = 250.0 * row.x / 99, deformation = 0.1 * row.y / 99;
    const double linear = modulus(published("LE-2D-FEM-19"), {{30, 0.16}, 0}, area, deformation, viscosity);
    const double hyperelastic = modulus(published("HE-2D-FEM-22"), {{30, 0.16}, 0}, area, deformation, viscosity);
    EXPECT_NEAR(linear, row.linear, 1e-12 * row.linear);
    EXPECT_NEAR(hyperelastic, row.hyperelastic, 1e-12 * row.hyperelastic);
  }
}

TEST(PublishedMap, MeetsEverySyntheticGoldenRow) {
  RHEOCYTE_NEED_REFERENCE("golden/emodulus_synthetic.csv");
  const auto golden = test::read_csv(test::reference_folder() / "golden/emodulus_synthetic.csv");
  ASSERT_EQ(golden.rows(), 300U);
  Comparison comparison;
  for (std::size_t i = 0; i < golden.rows(); ++i) {
    const Buffer buffer(medium_of_name(golden.text("medium", i)).value(),
                        viscosity_model_of_name(golden.text("visc_model", i)).value());
    const MeasuringConditions conditions{{golden.number("channel_width_um", i), golden.number("flow_rate_uL_s", i)},
                                         golden.number("px_um", i)};
    const double viscosity = buffer.viscosity(conditions.flow, golden.number("temperature_C", i));
    comparison.add(modulus(published(golden.text("lut", i)), conditions, golden.number("area_um", i),
                           golden.number("deform", i), viscosity),
                   golden.number("emodulus_kPa", i));
  }
  comparison.expect_parity("synthetic events");
}

TEST(PublishedMap, MeetsEveryGoldenRowOfRealFilesFromTheFilesThemselves) {
  RHEOCYTE_NEED_REFERENCE("golden/emodulus_real_files.csv");
  const auto golden = test::read_csv(test::reference_folder() / "golden/emodulus_real_files.csv");
  ASSERT_EQ(golden.rows(), 216U);
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> shapes;
  Comparison linear, hyperelastic;
  for (std::size_t i = 0; i < golden.rows(); ++i) {
    const auto& file = golden.text("file", i);
    const MeasuringConditions conditions{{golden.number("channel_width_um", i), golden.number("flow_rate_uL_s", i)},
                                         golden.number("px_um", i)};
    auto& [areas, deformations] = shapes[file];
    if (areas.empty()) {
      const Recording recording(test::reference_folder() / "rtdc" / file);
      EXPECT_EQ(recording.metadata().number("setup:channel width"), conditions.flow.width_um);
      EXPECT_EQ(recording.metadata().number("imaging:pixel size"), conditions.pixel_size_um);
      areas.resize(recording.events());
      deformations.resize(recording.events());
      ShapeSource(recording, conditions.pixel_size_um).read(0, areas, deformations);
    }
    const auto event = static_cast<std::size_t>(golden.number("event", i));
    std::string medium = golden.text("medium", i);
    medium = medium.substr(0, medium.find('('));
    const Buffer buffer(medium_of_name(medium).value(), viscosity_model_of_name(golden.text("visc_model", i)).value());
    const double viscosity = buffer.viscosity(conditions.flow, golden.number("temperature_C", i));
    const auto compare = [&](const char* name, const char* column, Comparison& comparison) {
      comparison.add(modulus(published(name), conditions, areas.at(event), deformations.at(event), viscosity),
                     golden.number(column, i));
    };
    compare("LE-2D-FEM-19", "E_LE2D_kPa", linear);
    compare("HE-2D-FEM-22", "E_HE2D_kPa", hyperelastic);
  }
  linear.expect_parity("real files, LE-2D-FEM-19");
  hyperelastic.expect_parity("real files, HE-2D-FEM-22");
}

TEST(PublishedMap, ReproducesTheModuliThatARecordingHolds) {
  RHEOCYTE_NEED_REFERENCE("rtdc/wide_channel_issue_212.rtdc");
  // LE-2D-FEM-19, Herold 2017, temperature of each event; stored by dclab 0.48 and quoted here.
  const double expected[] = {1.59169857, 2.38133343, 1.74618026, 1.7782649,  1.41646647,
                             1.58988067, 1.33683983, 1.50402551, 1.57157576, 2.37331995};
  const Recording recording(test::reference_folder() / "rtdc/wide_channel_issue_212.rtdc");
  std::vector<double> areas(10), deformations(10), temperatures(10), viscosities(10), moduli(10), stored(10);
  ShapeSource(recording, 0.339).read(0, areas, deformations);
  recording.read_scalar("temp", 0, temperatures);
  recording.read_scalar("emodulus", 0, stored);
  const Metadata& metadata = recording.metadata();
  const ChannelFlow flow{metadata.number("setup:channel width").value(), metadata.number("setup:flow rate").value()};
  Buffer(Medium::methyl_cellulose_059, ViscosityModel::herold_2017).viscosity(flow, temperatures, viscosities);
  published("LE-2D-FEM-19").moduli({flow, 0.339}, {areas, deformations, viscosities}, moduli);
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(moduli[i], expected[i], parity * expected[i]);
    EXPECT_NEAR(moduli[i], stored[i], parity * stored[i]);
  }
}

TEST(PublishedMap, OfAWholePopulationCountsAndMedianAreThoseOfDclab) {
  RHEOCYTE_NEED_REFERENCE("rtdc/example.rtdc");
  const Recording recording(test::reference_folder() / "rtdc/example.rtdc");
  std::vector<double> areas(recording.events()), deformations(areas.size()), moduli(areas.size());
  ShapeSource(recording, 0.34).read(0, areas, deformations);
  const double viscosity =
      Buffer(Medium::methyl_cellulose_049, ViscosityModel::buyukurganci_2022).viscosity({20, 0.06}, 23);
  const auto expect = [&](const char* name, std::size_t events, double median) {
    published(name).moduli({{20, 0.06}, 0.34}, {areas, deformations, {&viscosity, 1}}, moduli);
    std::vector<double> valid;
    for (const double value : moduli)
      if (std::isfinite(value)) valid.push_back(value);
    EXPECT_EQ(valid.size(), events) << name;
    std::ranges::sort(valid);
    const double ours = 0.5 * (valid[(valid.size() - 1) / 2] + valid[valid.size() / 2]);
    EXPECT_NEAR(ours, median, 5e-5) << name << ": printed to 1e-4";
  };
  expect("LE-2D-FEM-19", 3857, 1.0482);
  expect("HE-2D-FEM-22", 4526, 1.1518);
}

}  // namespace
}  // namespace rheocyte::published_map_test
