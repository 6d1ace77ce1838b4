// `rheocyte extract` with tables of rheocyte: without any argument, with errors that hold, and with named refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

#include "lookup_table_file.h"
#include "measurement/recording.h"
#include "measurement/recording_writer.h"
#include "robustness/run_program.h"
#include "synth/analytic_branches.h"
#include "table/grid_from_branches.h"
#include "table/table_folder.h"

namespace rheocyte::own_table_test {
namespace {

namespace fs = std::filesystem;
using test::RecordingWriter;

std::vector<double> column(const fs::path& file, const std::string& feature) {
  const Recording recording(file);
  std::vector<double> values(recording.events());
  recording.read_scalar(feature, 0, values);
  return values;
}

class OwnTable : public testing::Test {
 protected:
  test::Ended run(std::vector<std::string> arguments,
                  const std::map<std::string, std::string>& environment = {}) const {
    arguments.insert(arguments.begin(), RHEOCYTE);
    return test::run({arguments, environment});
  }
  void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) const {
    test::expect_sentence(run(arguments), words);
  }
  void write_recording(const std::string& name, const std::function<void(RecordingWriter&)>& more = {}) const {
    RecordingWriter writer(folder_ / name);
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {120, 10, 400, 80, 250, 80, 80});
    writer.scalar("deform", {0.016, 0.03, 0.03, -0.01, 0.3, NAN, 0.15});
    if (more) more(writer);
  }
  /// The folder of a table with branches of the analytical model: 4 to 40 kPa at 20 um, 0.04 ul/s, 15 mPa s.
  TableSpec write_closed_table(const std::string& name) const {
    const auto spec = parse_table_spec(
        "channel.width_um = 20\nflow.rate_ul_per_s = 0.04\nflow.viscosity_mPas = 15\n[table]\nidentifier = \"CLOSED\"\n"
        "stiffness = \"cell.bulk.young_modulus_kPa\"\nmin_area_um2 = 70\nmax_area_um2 = 210\nradii = 24\n"
        "min_deformation = 5e-4\nmax_deformation = 0.08\n",
        "table");
    const TableFolder folder(folder_ / name, spec);
    for (int i = 0; i < folder.branches(); ++i) folder.keep(i, test::analytic_branch(folder.place(i).radius_um), false);
    folder.publish("grid_CLOSED.cbor", to_bytes(make_stiffness_grid(spec, folder.read_all(), "test").value()));
    return spec;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  test::ScratchFolder folder_;
};

TEST_F(OwnTable, NothingButTheRecordingIsNeeded) {
  write_recording("a.rtdc");
  const auto square = run({"extract", path("a.rtdc")});
  ASSERT_EQ(square.exit_code, 0) << square.err;
  EXPECT_EQ(column(folder_ / "a_rheocyte.rtdc", "userdef0"), (std::vector<double>{0, 2, 3, 4, 5, 1, 5}))
      << "valid, too small, too large, too stiff, no data, and too soft twice";
  EXPECT_NE(test::content_of(folder_ / "rheocyte_summary.tsv").find("\tHE-3D-MC049-26\t"), std::string::npos);
  EXPECT_NE(square.err.find("29 % of the events are deformed beyond the smooth shapes of HE-3D-MC049-26"),
            std::string::npos)
      << square.err;
  const auto ended = run({"extract", path("a.rtdc"), "--section", "tube"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(column(folder_ / "a_rheocyte.rtdc", "userdef0"), (std::vector<double>{0, 2, 3, 4, 5, 1, 8}))
      << "valid, too small, too large, too stiff, too soft, no data, regularised";
  const auto modulus = column(folder_ / "a_rheocyte.rtdc", "emodulus"),
             error = column(folder_ / "a_rheocyte.rtdc", "userdef1");
  EXPECT_GT(error[0] / modulus[0], 0.02) << "2 to 5 % by the place between the pixels";
  EXPECT_LT(error[0] / modulus[0], 0.06);
  EXPECT_GT(error[6], 0);
  for (int i = 1; i < 6; ++i) EXPECT_TRUE(std::isnan(modulus[i]) && std::isnan(error[i])) << i;
  const auto events = test::content_of(folder_ / "a_rheocyte.tsv");
  EXPECT_TRUE(
      events.starts_with("event\tarea_um2\tdeformation\tviscosity_mPas\tyoung_modulus_kPa\t"
                         "young_modulus_kPa_error\tstate\n# rheocyte "))
      << "programs look for the names in the first line: " << events;
  std::istringstream lines(events);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    EXPECT_EQ(std::distance(std::istream_iterator<std::string>(words), {}), 7) << "no blanks inside: " << line;
  }
  EXPECT_NE(events.find("corrected for pixels: area and deformation"), std::string::npos);
  const auto summary = test::content_of(folder_ / "rheocyte_summary.tsv");
  EXPECT_NE(summary.find("\tLE-2D-MC049-26\t"), std::string::npos) << "that of the medium: " << summary;
  EXPECT_NE(ended.out.find("standard error"), std::string::npos) << ended.out;
  const Recording companion(folder_ / "a_rheocyte.rtdc");
  EXPECT_NE(companion.metadata().text("user:rheocyte userdef1").value_or("").find("standard error"), std::string::npos);
}

TEST_F(OwnTable, ARecordingsOwnUserFeaturesStayVisibleAndOursAreNamed) {
  const std::vector<double> its_own{7, 7, 7, 7, 7, 7, 7};
  write_recording("a.rtdc", [&](RecordingWriter& writer) {
    for (const std::string name : {"userdef0", "userdef1", "userdef3"}) writer.scalar(name, its_own);
  });
  ASSERT_EQ(run({"extract", path("a.rtdc"), "--section", "tube"}).exit_code, 0);
  const fs::path file = folder_ / "a_rheocyte.rtdc";
  for (const std::string name : {"userdef0", "userdef1", "userdef3"}) EXPECT_EQ(column(file, name), its_own);
  const Recording companion(file);
  const auto name_of = [&](const std::string& role) { return companion.metadata().text("user:rheocyte " + role); };
  EXPECT_EQ(name_of("state"), "userdef2");
  EXPECT_EQ(name_of("young_modulus_kPa_error"), "userdef4");
  EXPECT_EQ(column(file, "userdef2"), (std::vector<double>{0, 2, 3, 4, 5, 1, 8}));
  EXPECT_GT(column(file, "userdef4")[0], 0);
}

TEST_F(OwnTable, AModulusBelowItsStandardErrorIsUnresolved) {
  {
    RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {60, 60});
    writer.scalar("deform", {0.0076, 0.02});
  }
  ASSERT_EQ(run({"extract", path("a.rtdc")}).exit_code, 0);
  EXPECT_EQ(column(folder_ / "a_rheocyte.rtdc", "userdef0"), (std::vector<double>{7, 0}));
  EXPECT_TRUE(std::isnan(column(folder_ / "a_rheocyte.rtdc", "emodulus")[0]));
}

TEST_F(OwnTable, AgreesWithThePublishedTableOfTheSameModel) {
  {
    RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80});
    writer.scalar("deform", {0.03});
  }
  ASSERT_EQ(run({"extract", path("a.rtdc"), "--section", "tube", "--no-pixelation", "--viscosity-mPas", "5.3563",
                 "--flow-rate-ul-s", "0.06"})
                .exit_code,
            0);
  // By LE-2D-FEM-19, whose moduli ours meet to 0.4 %.
  EXPECT_NEAR(column(folder_ / "a_rheocyte.rtdc", "emodulus")[0], 1.0486, 0.004 * 1.0486);
}

TEST_F(OwnTable, IsFoundByIdentifierFileAndFolder) {
  write_recording("a.rtdc");
  write_closed_table("table");
  const auto modulus = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"extract", path("a.rtdc")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return column(folder_ / "a_rheocyte.rtdc", "emodulus")[0];
  };
  EXPECT_EQ(modulus({}), modulus({"--table", "HE-3D-MC049-26"}));
  EXPECT_EQ(modulus({"--section", "tube"}), modulus({"--table", "LE-2D-MC049-26"}));
  const double by_folder = modulus({"--table", path("table")});
  EXPECT_EQ(by_folder, modulus({"--table", path("table/grid_CLOSED.cbor")}));
  EXPECT_NEAR(by_folder / modulus({"--section", "tube"}), 1, 0.05)
      << "the analytical model against simulations at a deformation of 0.01";
  EXPECT_LT(modulus({"--no-area-correction"}), 0.99 * modulus({}));
  fs::remove(folder_ / "table/grid_CLOSED.cbor");
  expect_refusal({"extract", path("a.rtdc"), "--table", path("table")}, "contains no grid_*.cbor");
}

TEST_F(OwnTable, ContradictingOptionsAndMissingTablesAreRefused) {
  write_recording("a.rtdc");
  test::write_lookup_table(folder_ / "table.txt");
  expect_refusal({"extract", path("a.rtdc"), "--table", path("table.txt"), "--no-area-correction"},
                 "--no-area-correction and --table");
  expect_refusal({"extract", path("a.rtdc"), "--table", "LE-2D-27"}, "did you mean LE-2D-26");
  std::ofstream(folder_ / "grid_broken.cbor") << "no grid";
  expect_refusal({"extract", path("a.rtdc"), "--table", path("grid_broken.cbor")}, "cannot be used");
  fs::create_directories(folder_ / "empty");
  const auto ended = run({"extract", path("a.rtdc")}, {{"RHEOCYTE_TABLES", path("empty")}});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("give one with --table"), std::string::npos) << ended.err;
}

TEST_F(OwnTable, GatesShutEventsOut) {
  {
    RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80, 90, 100, 110});
    writer.scalar("deform", {0.03, 0.03, 0.03, 0.03});
    writer.scalar("area_cvx", {800, 900, 1000, 1100});
    writer.scalar("area_msd", {790, 800, 990, NAN});
  }
  const auto ended = run({"extract", path("a.rtdc"), "--max", "area_ratio=1.05", "--min", "area_um=85"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(column(folder_ / "a_rheocyte.rtdc", "userdef0"), (std::vector<double>{9, 9, 0, 9}));
  EXPECT_TRUE(std::isnan(column(folder_ / "a_rheocyte.rtdc", "emodulus")[0]));
  EXPECT_NE(ended.out.find("1 of 4 events"), std::string::npos) << ended.out;
  EXPECT_NE(test::content_of(folder_ / "rheocyte_summary.tsv").find("85 <= area_um, area_ratio <= 1.05"),
            std::string::npos);
  expect_refusal({"extract", path("a.rtdc"), "--max", "area_ratio"}, "give a feature and a number");
  const auto unknown = run({"extract", path("a.rtdc"), "--max", "bright=5"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("has no feature bright"), std::string::npos) << unknown.err;
  expect_refusal({"extract", path("a.rtdc"), "--max", "area_ration=1.05", "--quiet"},
                 "has no feature area_ration, for which --max gives a limit. Did you mean area_ratio?");
  expect_refusal({"extract", path("a.rtdc"), "--polygon", "area_umm,deform=1,0:2,0:2,1", "--quiet"},
                 "Did you mean area_um?");
  const auto none = run({"extract", path("a.rtdc"), "--max", "area_um=5"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("outside the table HE-3D-MC049-26 or the gates"), std::string::npos) << none.err;
}

TEST_F(OwnTable, AShearThinningMediumGetsTheTableOfItsLiquid) {
  write_recording("a.rtdc");  // in CellCarrier at 23 degC: exponent 0.655
  const auto spec = write_closed_table("table");
  auto grid = grid_from_bytes(test::content_of(folder_ / "table/grid_CLOSED.cbor"), "grid");
  fs::create_directories(folder_ / "shipped");
  const auto ship = [&](const std::string& identifier, double exponent, double factor) {
    auto other = grid;
    other.origin.identifier = identifier;
    other.origin.flow.exponent = exponent;
    for (double& value : other.patches[0].log_stiffness) value += std::log(factor);
    test::write_file(folder_ / ("shipped/" + grid_file_name(identifier)), to_bytes(other));
  };
  ship("NEWTON", 1, 1);
  ship("FAR", 0.5, 3);
  const auto extract = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"extract", path("a.rtdc")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, {{"RHEOCYTE_TABLES", path("shipped")}});
  };
  EXPECT_EQ(extract().err.find("shear-thinning"), std::string::npos) << "no table has such a liquid";
  const double newtonian = column(folder_ / "a_rheocyte.rtdc", "emodulus")[0];
  ship("THINNING", 0.66, 1.1);
  const auto ended = extract();
  EXPECT_NEAR(column(folder_ / "a_rheocyte.rtdc", "emodulus")[0] / (1.1 * newtonian), 1, 1e-6) << "single precision";
  EXPECT_NE(ended.err.find("moduli are from THINNING (its liquid has the exponent 0.66); those from NEWTON with the "
                           "effective viscosity are 9.1 % smaller (geometric mean of 1 events)."),
            std::string::npos)
      << ended.err;
  EXPECT_NE(test::content_of(folder_ / "rheocyte_summary.tsv").find("9.1 % smaller"), std::string::npos);
  EXPECT_NE(extract({"--table", "NEWTON"}).err.find("those from THINNING"), std::string::npos) << "as the user wants";
  EXPECT_EQ(extract({"--viscosity-mPas", "5"}).err, "") << "of a viscosity alone nothing is known";
}

TEST_F(OwnTable, TablesOfTheSquareChannelAreTakenWhereThereAreAny) {
  write_recording("a.rtdc");
  write_closed_table("table");
  auto grid = grid_from_bytes(test::content_of(folder_ / "table/grid_CLOSED.cbor"), "grid");
  fs::create_directories(folder_ / "shipped");
  const auto extract = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"extract", path("a.rtdc"), "--viscosity-mPas", "5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, {{"RHEOCYTE_TABLES", path("shipped")}});
  };
  const auto ship = [&](const std::string& identifier, Section section) {
    grid.origin.identifier = identifier;
    grid.origin.section = section;
    test::write_file(folder_ / ("shipped/" + grid_file_name(identifier)), to_bytes(grid));
  };
  ship("TUBE", Section::tube);
  EXPECT_NE(extract({"--section", "square"}).err.find("tables of the square channel"), std::string::npos);
  ASSERT_EQ(extract().exit_code, 0);
  const double tube = column(folder_ / "a_rheocyte.rtdc", "emodulus")[0];
  for (double& value : grid.patches[0].log_stiffness) value += std::log(1.05);
  ship("SQUARE", Section::square);
  const auto modulus = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(extract(more).exit_code, 0);
    return column(folder_ / "a_rheocyte.rtdc", "emodulus")[0];
  };
  EXPECT_NEAR(modulus({}) / (1.05 * tube), 1, 1e-6) << "single precision";
  EXPECT_NE(test::content_of(folder_ / "rheocyte_summary.tsv").find("\tSQUARE\t"), std::string::npos);
  EXPECT_EQ(modulus({"--section", "square"}), modulus({}));
  EXPECT_EQ(modulus({"--section", "tube"}), tube);
  EXPECT_EQ(extract({"--section", "square", "--table", "TUBE"}).exit_code, 2) << "a table that is named is used";
  EXPECT_EQ(extract({"--section", "round"}).exit_code, 2);
}

TEST_F(OwnTable, EachMediumGetsItsOwnAtEveryTemperature) {
  // Over the temperatures for which the media were measured, 22 to 37 degC; water does not thin.
  write_recording("a.rtdc");
  const std::map<std::string, std::string> media{
      {"CellCarrier", "-MC049-26"}, {"CellCarrierB", "-MC059-26"}, {"0.83% MC-PBS", "-MC083-26"}, {"water", "-26"}};
  for (const auto& [medium, table] : media)
    for (const std::string temperature : {"22", "37"}) {
      for (const auto& [section, law] : {std::pair{"square", "HE-3D"}, {"tube", "LE-2D"}}) {
        ASSERT_NE(
            run({"extract", path("a.rtdc"), "--medium", medium, "--temperature", temperature, "--section", section})
                .exit_code,
            2);
        const auto summary = test::content_of(folder_ / "rheocyte_summary.tsv");
        EXPECT_NE(summary.find("\t" + (law + table) + "\t"), std::string::npos) << medium << temperature << summary;
      }
    }
}

TEST_F(OwnTable, TablesAreComparedWithThoseOfTheSameSolid) {
  write_recording("a.rtdc");
  const std::string linear = "LE-3D-", neo_hookean = "HE-3D-";
  for (const auto& solid : {linear, neo_hookean}) {
    const auto ended = run({"extract", path("a.rtdc"), "--table", solid + "26", "--medium", "CellCarrier"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_NE(ended.err.find("those from " + solid + "MC049-26"), std::string::npos) << ended.err;
  }
}

TEST_F(OwnTable, ModuliComeBackAndIntervalsHoldWhatTheyPromise) {
  write_closed_table("table");
  struct Population {
    double modulus, deviation, radius;
  };
  for (const auto& [modulus, deviation, radius] : {Population{5, 0.3, 6.2}, {6, 0.4, 7}, {9, 0.6, 7.2}}) {
    test::write_file(
        folder_ / "spec.toml",
        "[recording]\ncells = 500\npictures = \"none\"\n[channel]\nwidth_um = 20\n[flow]\n"
        "rate_ul_per_s = 0.04\nviscosity_mPas = 15\n[shapes]\ntable = \"table\"\n[cell]\nradius_um = {mean = " +
            std::to_string(radius) + ", sd = 0.3}\nbulk.young_modulus_kPa = {mean = " + std::to_string(modulus) +
            ", sd = " + std::to_string(deviation) + "}\n");
    fs::remove(folder_ / "v.rtdc");
    ASSERT_EQ(run({"synth", path("spec.toml"), "-o", path("v.rtdc")}).exit_code, 0);
    const auto ended = run({"extract", path("v.rtdc"), "--table", path("table")});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto found = column(folder_ / "v_rheocyte.rtdc", "emodulus"),
               error = column(folder_ / "v_rheocyte.rtdc", "userdef7"), truth = column(folder_ / "v.rtdc", "userdef2");
    std::vector<double> bias;
    int covered = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (std::isnan(found[i])) continue;
      bias.push_back(found[i] / truth[i] - 1);
      covered += std::abs(found[i] - truth[i]) < 1.645 * error[i];
    }
    ASSERT_GT(bias.size(), 440U) << ended.out;
    std::ranges::nth_element(bias, bias.begin() + static_cast<std::ptrdiff_t>(bias.size() / 2));
    EXPECT_NEAR(bias[bias.size() / 2], 0, 0.01) << modulus;
    const double fraction = covered / static_cast<double>(bias.size());
    EXPECT_GT(fraction, 0.85) << modulus;
    EXPECT_LT(fraction, 0.95) << modulus;
    RecordProperty("bias and fraction at " + std::to_string(modulus),
                   std::to_string(bias[bias.size() / 2]) + " " + std::to_string(fraction));
  }
}

TEST_F(OwnTable, AnAddedEllipseIsTold) {
  write_closed_table("table");
  for (const double ellipse : {0.0, 0.1}) {
    test::write_file(folder_ / "spec.toml",
                     "[recording]\ncells = 300\n[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\n"
                     "viscosity_mPas = 15\n[shapes]\ntable = \"table\"\n[cell]\nradius_um = {mean = 6.2, sd = 0.3}\n"
                     "bulk.young_modulus_kPa = {mean = 5, sd = 0.3}\nadded_ellipse = " +
                         std::to_string(ellipse) + "\n");
    fs::remove(folder_ / "v.rtdc");
    ASSERT_EQ(run({"synth", path("spec.toml"), "-o", path("v.rtdc")}).exit_code, 0);
    const auto ended = run({"extract", path("v.rtdc"), "--table", path("table")});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto* const words = ellipse > 0 ? "elongated along the flow more than neo-Hookean solids in the tube"
                                          : "the shapes are those of the model, neo-Hookean solids in the tube";
    EXPECT_NE(ended.out.find(words), std::string::npos) << ended.out;
    EXPECT_NE(ended.out.find("seen at one place"), std::string::npos) << ended.out;
    // A table of the tube has no elongated cells.
    EXPECT_NE(ended.out.find("there is no table of elongated cells for this channel"), std::string::npos) << ended.out;
  }
}

TEST_F(OwnTable, TheCompanionHoldsVolumeAndInertiaRatiosWhereTheRecordingIsGone) {
  ASSERT_EQ(run({"synth", EXAMPLES "/recordings/virtual-cells.toml", "-o", path("v.rtdc"), "--set",
                 "recording.cells=20", "--quiet"})
                .exit_code,
            0);
  ASSERT_EQ(run({"features", path("v.rtdc"), "--quiet"}).exit_code, 0);
  ASSERT_EQ(run({"extract", path("v.rtdc"), "--quiet"}).exit_code, 0);
  fs::remove(folder_ / "v.rtdc");
  for (const std::string name : {"volume", "inert_ratio_cvx", "inert_ratio_raw", "inert_ratio_prnc"}) {
    const auto copied = column(folder_ / "v_rheocyte.rtdc", name),
               computed = column(folder_ / "v_features_rheocyte.rtdc", name);
    EXPECT_EQ((std::vector<float>{copied.begin(), copied.end()}),
              (std::vector<float>{computed.begin(), computed.end()}))
        << name;
  }
}

TEST_F(OwnTable, WhatARecordingLacksForItsShapesIsNamed) {
  write_recording("a.rtdc");
  EXPECT_NE(run({"extract", path("a.rtdc")}).out.find("neither inert_ratio_cvx nor contours nor masks"),
            std::string::npos);
  write_recording("b.rtdc", [](RecordingWriter& writer) {
    writer.scalar("inert_ratio_cvx", {1.01, 1.01, 1.01, 1.01, 1.01, 1.01, 1.01});
  });
  const auto ended = run({"extract", path("b.rtdc")});
  EXPECT_NE(ended.out.find("neither contours nor masks"), std::string::npos) << ended.out;
  const auto events = test::content_of(folder_ / "b_rheocyte.tsv");
  EXPECT_NE(
      events.find("\tstate\tshape_excess\tshape_excess_error\telongated\todd_fraction\tyoung_modulus_inertia_kPa\t"
                  "young_modulus_inertia_kPa_error\telongation\taxial_tension_Pa\telongation_error\t"
                  "axial_tension_Pa_error\n"),
      std::string::npos);
}

}  // namespace
}  // namespace rheocyte::own_table_test
