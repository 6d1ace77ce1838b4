// The text of an own table gives the same moduli whether a program scales the events to the table's channel or the
// table to that of the events, as dclab does: no diagonal of its triangles is left to rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "infer/published_map.h"
#include "measurement/recording_writer.h"
#include "table/invented_branch.h"
#include "table/lookup_table.h"

namespace rheocyte::own_text_table_test {
namespace {

PublishedTable text_of_own_table(Abscissa abscissa, const std::vector<std::string>& settings) {
  const TableSpec spec = parse_table_spec(test::short_spec, "spec.toml", settings);
  const test::ScratchFolder folder;
  std::ofstream(folder / "lut.txt") << lut_text(make_lookup_table(spec, test::invented_branches(spec, 40), "0"),
                                                abscissa);
  return read_published_table(folder / "lut.txt");
}

struct Events {
  std::vector<double> size, deformation;
};

Events random_events(Abscissa abscissa, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  Events events;
  for (int i = 0; i < count; ++i) {
    const double area = 40 + 240 * unit(random);
    events.size.push_back(abscissa == Abscissa::area ? area : std::pow(area, 1.5) * 0.752);  // of a sphere
    events.deformation.push_back(5e-5 * std::pow(0.19 / 5e-5, unit(random)));
  }
  return events;
}

double scale(Abscissa abscissa, double width_um) { return std::pow(width_um / 20, abscissa == Abscissa::area ? 2 : 3); }

std::vector<double> moduli(const PublishedTable& table, double width_um, const Events& events) {
  MeasuringConditions conditions;
  conditions.flow.width_um = width_um;
  conditions.flow.rate_ul_s = 0.04;
  std::vector<double> sizes = events.size, result(events.size.size());
  for (double& size : sizes) size *= scale(table.abscissa, width_um);
  const double viscosity = 15;
  PublishedMap(table).moduli(conditions, {sizes, events.deformation, {&viscosity, 1}}, result);
  return result;
}

PublishedTable scaled_to(double width_um, PublishedTable table) {
  for (double& size : table.size) size *= scale(table.abscissa, width_um);
  for (double& modulus : table.modulus_kPa) modulus *= std::pow(20 / width_um, 3);
  table.flow.width_um = width_um;
  return table;
}

class OwnTextTable : public testing::TestWithParam<Abscissa> {};

TEST_P(OwnTextTable, ModuliDoNotDependOnWhatIsScaled) {
  const Events events = random_events(GetParam(), 5000);
  const PublishedTable table = text_of_own_table(GetParam(), {"table.radii=33", "table.rows_per_radius=77"});
  for (const double width : {15.0, 17.3, 25.0, 30.0, 40.0}) {
    const auto ours = moduli(table, width, events), theirs = moduli(scaled_to(width, table), width, events);
    int finite = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      ASSERT_EQ(std::isfinite(ours[i]), std::isfinite(theirs[i])) << width;
      if (!std::isfinite(ours[i])) continue;
      ++finite;
      EXPECT_NEAR(ours[i] / theirs[i], 1, 1e-9) << "rounding, magnified in slivers";
    }
    EXPECT_GT(finite, 4500);
  }
}

INSTANTIATE_TEST_SUITE_P(ByAreaAndByVolume, OwnTextTable, testing::Values(Abscissa::area, Abscissa::volume));

}  // namespace
}  // namespace rheocyte::own_text_table_test
