// `rheocyte population` with recordings that contain less than a population: cells beyond the table, features that
// are missing, set-ups that differ.
#include "measurement/recording_writer.h"
#include "numeric/cell_random.h"
#include "population_fixture.h"

namespace rheocyte::test::population_limits_test {
namespace {

using population_test::PopulationCommand;

/// Solids in CellCarrier, of a mean of E in kPa, by a table that goes on to softer ones than that of `population`.
std::string solids(double modulus_kPa) {
  return fmt::format(
      "[recording]\ncells = 300\n[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\nmedium = "
      "\"CellCarrier\"\ntemperature_C = 23\n[cell]\nkind = \"solid\"\nradius_um = {{mean = 6.2, sd = 0.5}}\n"
      "[cell.bulk]\nyoung_modulus_kPa = {{mean = {}, sd = {}}}\n[shapes]\ntable = \"LE-2D-MC049-26\"\n",
      modulus_kPa, 0.1 * modulus_kPa);
}

TEST_F(PopulationCommand, TheShareOfCellsBeyondTheTableStandsInTheResult) {
  write_file(folder_.path() / "soft.toml", solids(0.9));
  synth("a.rtdc", {}, "soft.toml");
  synth("b.rtdc", {"recording.seed=2"}, "soft.toml");
  const auto done = call({"population", "--condition", "a=a.rtdc", "--condition", "b=b.rtdc", "--no-picture"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find(", and beyond the table "), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("; beyond the table: "), std::string::npos) << done.out;
  const auto recording = record()["recordings"][0];
  const double softer = recording["beyond_table_softer"], all = recording["beyond_table_events"];
  EXPECT_GT(softer, 0);
  EXPECT_EQ(recording["beyond_table_larger"], 0);
  EXPECT_EQ(recording["beyond_table_fraction"], all / (all + double(recording["events"])));
}

/// The median of all cells is below the bound, and the softest cell of the table is not far.
TEST_F(PopulationCommand, CellsOfWhichMostAreSofterThanTheTableHaveABoundAndNoNumber) {
  write_file(folder_.path() / "soft.toml", solids(0.75));
  write_file(folder_.path() / "stiff.toml", solids(2));
  synth("soft.rtdc", {}, "soft.toml");
  synth("stiff.rtdc", {}, "stiff.toml");
  synth("more.rtdc", {"recording.seed=5"}, "stiff.toml");
  const auto done = call(
      {"population", "--condition", "control=stiff.rtdc", "--condition", "drug=soft.rtdc,more.rtdc", "--no-picture"});
  EXPECT_EQ(done.exit_code, 3) << done.err;
  EXPECT_NE(done.err.find("are softer or longer than the cells of the table"), std::string::npos) << done.err;
  EXPECT_NE(done.out.find("drug: no number, because soft.rtdc has none"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("drug / control: no ratio, because drug has no number"), std::string::npos) << done.out;
  const auto recording = record()["recordings"][1];
  EXPECT_TRUE(recording["young_modulus_median_kPa"].is_null());
  EXPECT_GT(recording["young_modulus_below_kPa"], 0.75);
  EXPECT_LT(recording["young_modulus_below_kPa"], 1.1);
}

/// Areas and deformations of cells as the flow alone makes them.
TEST_F(PopulationCommand, AreaAndDeformationAloneDoForCellsThatNothingElseElongates) {
  {
    RecordingWriter writer(folder_.path() / "two.rtdc");
    write_usual_metadata(writer);
    std::vector<double> area, deformation;
    for (std::uint64_t k = 0; k < 60; ++k) {
      CellRandom random(1, k, Purpose::population);
      area.push_back(120 + 10 * random.normal());
      deformation.push_back(0.02 + 0.003 * random.normal());
    }
    writer.scalar("area_um", area);
    writer.scalar("deform", deformation);
  }
  expect_sentence(call({"population", "--condition", "a=two.rtdc"}), "else with --by deformation");
  expect_sentence(call({"population", "--condition", "a=two.rtdc", "--by", "odd-deformation"}),
                  "--by deformation fits a population of cells that nothing but the flow elongates");
  const auto done = call({"population", "--condition", "a=two.rtdc", "--by", "deformation", "--no-picture"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.err.find("E is that of cells which nothing but the flow elongates"), std::string::npos) << done.err;
  EXPECT_EQ(done.out.find("nan"), std::string::npos) << done.out;
  const auto recording = record()["recordings"][0];
  EXPECT_TRUE(recording["elongation_median"].is_null());
  EXPECT_EQ(recording["checks"].size(), 2) << "area and deformation";
  // Another table, event by event, gives about the same: four standard errors, and 2 % between the tables.
  const Ended by_events = call({"extract", "two.rtdc"});
  const std::string told = "events, E median ";
  const auto at = by_events.out.find(told);
  ASSERT_NE(at, std::string::npos) << by_events.out;
  const auto& log_modulus = recording["parameters"][1];
  EXPECT_NEAR(log_modulus["value"], std::log(std::stod(by_events.out.substr(at + told.size()))),
              4 * double(log_modulus["value_error"]) + 0.02);
}

TEST_F(PopulationCommand, ConditionsThatDifferInMoreThanTheirCellsAreToldWithNumbers) {
  synth("a.rtdc", {"recording.cells=60"});
  synth("b.rtdc", {"recording.cells=60", "recording.seed=5", "flow.rate_ul_per_s=0.05"});
  const auto done = call({"population", "--condition", "a=a.rtdc", "--condition", "b=b.rtdc", "--no-picture"});
  EXPECT_NE(done.err.find("b and a differ in flow rate (0.04 ul/s and 0.05 ul/s)"), std::string::npos) << done.err;
  EXPECT_EQ(record()["warnings"].size(), 1);
}

TEST_F(PopulationCommand, InertiaIsTold) {
  synth("a.rtdc",
        {"recording.cells=60", "flow.viscosity_mPas=0.7", "flow.rate_ul_per_s=0.08", "flow.axial_tension_Pa.mean=50",
         "flow.axial_tension_Pa.sd=10", "cell.bulk.young_modulus_kPa.mean=1", "cell.bulk.young_modulus_kPa.sd=0.1"});
  const auto done = call({"population", "--condition", "a=a.rtdc", "--no-picture"});
  EXPECT_NE(done.err.find("events have Reynolds numbers above 3"), std::string::npos) << done.err;
}

}  // namespace
}  // namespace rheocyte::test::population_limits_test
