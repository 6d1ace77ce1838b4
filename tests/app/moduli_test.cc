// `rheocyte moduli` from a recording with masks to the table of events.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <tuple>

#include "../robustness/run_program.h"
#include "../table/invented_combined.h"
#include "../table/invented_elongated_combined.h"
#include "analytic/effective_modulus.h"
#include "measurement/mask_from_outline.h"
#include "measurement/recording.h"
#include "measurement/recording_writer.h"

namespace rheocyte::test::moduli_test {
namespace {

namespace fs = std::filesystem;

constexpr int events = 40;
constexpr double pixel_um = 0.34;

/// All alike, at random places between the pixels, numbered from 1; the last one's temperature is not a number.
void write_recording(const fs::path& file, const Eigen::MatrixX2d& outline_um) {
  const ImageSize size{120, 70};
  std::vector<std::uint8_t> all, mask(size.pixels());
  std::vector<double> index, temperature;
  std::mt19937 engine(3);
  std::uniform_real_distribution place(-0.5, 0.5);
  for (int i = 0; i < events; ++i) {
    const Eigen::RowVector2d middle(60 + place(engine), 35 + place(engine));
    ASSERT_TRUE(fill_mask((outline_um / pixel_um).rowwise() + middle, size, mask));
    all.insert(all.end(), mask.begin(), mask.end());
    index.push_back(i + 1);
    temperature.push_back(i < 3 ? 40 : i + 1 < events ? 25 : NAN);
  }
  RecordingWriter writer(file);
  write_usual_metadata(writer);
  writer.integer("experiment:event count", events);
  writer.scalar("index", index);
  writer.scalar("temp", temperature);
  writer.images("mask", all, size.height, size.width);
}

/// The lines of a table of events, by their columns' names.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& table) {
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream fields(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(fields, cell, '\t');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (k == 0) rows.emplace_back();
      rows.back()[names.at(k)] = cells[k];
    }
  }
  return rows;
}

class ModuliCommand : public testing::Test {
 protected:
  void SetUp() override {
    const CombinedTable& table = whole_combined_table();
    fs::create_directory(table_folder());
    write_file(table_folder() / "spec.toml", to_toml(table.spec));
    write_file(table_folder() / combined_table_name(table.spec), combined_table_csv(table));
    // E = 0.6 kPa, E2D = 4.2 mN/m at the table's viscosity, without tension.
    write_recording(recording(), invented_outline({7, 0.5, 0}, 1.2));
  }
  fs::path table_folder() const { return folder_.path() / "table"; }
  fs::path recording() const { return folder_.path() / "M1.rtdc"; }
  Ended moduli(std::vector<std::string> more) const {
    std::vector<std::string> all{RHEOCYTE, "moduli", recording().string(), "--section", "tube", "--table"};
    all.insert(all.end(), more.begin(), more.end());
    return run({all});
  }

  std::string table() const { return content_of(folder_.path() / "M1_moduli.tsv"); }
  void expect_refusal(const std::vector<std::string>& options, const std::string& words) const {
    const Ended ended = moduli(options);
    EXPECT_EQ(ended.exit_code, 2) << words;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << ended.err;
  }

  TemporaryFolder folder_;
};

TEST_F(ModuliCommand, TheCellsOfARecordingHaveTheirModuli) {
  // The same cells with a tension, at twice the table's viscosity, by a table of three tensions: means within 10 % of
  // twice the moduli (single ones have about 10 and 20 %).
  write_recording(recording(), invented_outline({7, 0.5, 0.15}, 1.2));
  const Ended ended = moduli({table_folder().string(), "--viscosity-mPas", "30", "--fit-tension"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto rows = rows_of(table());
  ASSERT_EQ(rows.size(), std::size_t(events));
  double young = 0, stiffness = 0;
  for (const auto& row : rows) {
    young += std::stod(row.at("young_modulus_kPa")) / events;
    stiffness += std::stod(row.at("stiffness_kPa")) / events;
  }
  EXPECT_NEAR(young / 1.2, 1, 0.1);
  EXPECT_NEAR(stiffness / 2.4, 1, 0.1);
}

TEST_F(ModuliCommand, AFullDiskLeavesTheOlderResultAsItWas) {
  const auto call = [&](const std::string& viscosity, long most) {
    return run({.arguments = {RHEOCYTE, "moduli", recording().string(), "--section", "tube", "--table",
                              table_folder().string(), "--viscosity-mPas", viscosity},
                .max_file_bytes = most});
  };
  const auto summary = [&] { return content_of(folder_.path() / "M1_moduli.json"); };
  ASSERT_EQ(call("15", -1).exit_code, 0);
  const std::string events_before = table(), summary_before = summary();
  ASSERT_NE(events_before.size(), summary_before.size());
  // So much that one of the two files is complete and the other one is not, and less.
  const auto enough_for_one = long(std::min(events_before.size(), summary_before.size())) + 50;
  for (const long most : {100L, enough_for_one}) {
    const Ended ended = call("30", most);
    EXPECT_EQ(ended.exit_code, 2) << ended.err;
    EXPECT_EQ(table(), events_before) << most;
    EXPECT_EQ(summary(), summary_before) << most;
  }
}

TEST_F(ModuliCommand, EventsOutsideTheGatesAreNotFitted) {
  const auto status_of_events = [&](const std::vector<std::string>& gates) {
    std::vector<std::string> options{table_folder().string(), "--viscosity-mPas", "15"};
    options.insert(options.end(), gates.begin(), gates.end());
    const Ended ended = moduli(options);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const int counted = gates.empty() ? 0 : events - 4;
    if (counted > 0) {
      EXPECT_NE(ended.out.find(std::to_string(counted) + " gated"), std::string::npos) << ended.out;
    }
    return rows_of(table());
  };
  const auto all = status_of_events({}), some = status_of_events({"--min", "index=7", "--max", "index=10"});
  ASSERT_EQ(some.size(), std::size_t(events));
  for (int i = 0; i < events; ++i) {
    if (i + 1 >= 7 && i + 1 <= 10) {
      EXPECT_EQ(some[i], all[i]) << "a gate changes nothing of those inside";
    } else {
      EXPECT_EQ(some[i].at("status"), "gated");
      EXPECT_EQ(some[i].at("young_modulus_kPa"), "nan");
      EXPECT_EQ(some[i].at("stiffness_kPa"), "nan") << "no number stands where nothing was fitted";
      EXPECT_EQ(some[i].at("area_um2"), all[i].at("area_um2"));
    }
  }
  EXPECT_NE(table().find("# only events with 7 <= index <= 10\n"), std::string::npos);
  const auto within = status_of_events({"--polygon", "index,index=6.5,6.5:10.5,6.5:10.5,10.5:6.5,10.5"});
  EXPECT_EQ(within, some) << "a square polygon is a range gate";
  EXPECT_NE(table().find("# only events with index,index in a polygon of 4 corners\n"), std::string::npos);
  const std::string folder = table_folder().string();
  expect_refusal({folder, "--min", "bright=4"}, "has no feature bright, for which --min gives a limit");
  expect_refusal({folder, "--min", "index=5", "--max", "index=4"}, "contradict each other");
}

TEST_F(ModuliCommand, EachEventHasTheViscosityOfItsTemperature) {
  const Ended ended = moduli({table_folder().string()});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("3 events have temperatures outside 22 to 37 degC"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("is shear-thinning with the exponent 0.6"), std::string::npos) << ended.err;
  const auto rows = rows_of(table());
  ASSERT_EQ(rows.size(), std::size_t(events));
  // By eq:buyukurganci at 40 and 25 degC; six digits are printed.
  EXPECT_NEAR(std::stod(rows[0].at("viscosity_mPas")), 4.349150, 1e-5);
  EXPECT_NEAR(std::stod(rows[5].at("viscosity_mPas")), 5.227908, 1e-5);
  EXPECT_EQ(rows.back().at("viscosity_mPas"), "nan");
  EXPECT_EQ(rows.back().at("status"), "no-data") << "without a viscosity there are no moduli";
}

TEST_F(ModuliCommand, TheSettingsStandAboveTheEvents) {
  ASSERT_EQ(moduli({table_folder().string(), "--viscosity-mPas", "15", "--max", "index=1"}).exit_code, 0);
  const std::string text = table();
  for (const std::string line : {"channel width: 20 um", "flow rate: 0.04 ul/s", "pixel size: 0.34 um",
                                 "viscosity: 15 mPa s", "only events with index <= 1"})
    EXPECT_NE(text.find("\n# " + line + "\n"), std::string::npos) << line << "\n" << text.substr(0, 600);
  ASSERT_EQ(moduli({table_folder().string(), "--max", "index=1"}).exit_code, 0);
  EXPECT_NE(table().find("\n# viscosity: 0.49% MC-PBS by buyukurganci-2022, temperature of each event\n"),
            std::string::npos)
      << table().substr(0, 600);
}

TEST_F(ModuliCommand, SaysInOneLineWhatARecordingHolds) {
  const Ended ended = moduli({table_folder().string(), "--viscosity-mPas", "15", "--quiet"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.out + ended.err, "");
  const Ended all = moduli({table_folder().string(), "--viscosity-mPas", "15"});
  EXPECT_TRUE(is_one_line(all.out)) << all.out;
  for (const std::string words :
       {" of 40 events resolved, E median 0.", "E2D median ", "E + E2D/r0 median 1.", "effective E median "})
    EXPECT_NE(all.out.find(words), std::string::npos) << words << "\n" << all.out;
}

TEST_F(ModuliCommand, ARecordingWithoutMadeOutModuliIsSaidAndHasItsExitCode) {
  // 3 where no event has the shape of a cell of the table; 0 where bulk and cortex cannot be determined separately, for
  // their sum is a result; as `rheocyte extract`, 2 comes before 3.
  const auto expect = [&](const std::vector<std::string>& more, int exit_code, const std::string& words) {
    std::vector<std::string> options{table_folder().string(), "--viscosity-mPas", "15"};
    options.insert(options.end(), more.begin(), more.end());
    const Ended ended = moduli(options);
    EXPECT_EQ(ended.exit_code, exit_code) << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << ended.err;
    EXPECT_EQ(rows_of(table()).size(), std::size_t(events)) << "the table of events is written all the same";
  };
  expect({"--min", "index=100"}, 3, "no event inside the gates has the shape of a cell of the table XC-2D-26");
  // Pixels twice as large, and so the cells.
  expect({"--pixel-size-um", "0.68"}, 3,
         "no event has the shape of a cell of the table XC-2D-26: 0 of 40 events resolved; ");
  write_recording(recording(), invented_outline({6, 0.02, 0}, 3));
  expect({}, 0, "no event determines bulk and cortex separately");

  {
    RecordingWriter writer(folder_.path() / "M2.rtdc");
    write_usual_metadata(writer);
    writer.scalar("area_um", {80, 90});
    writer.scalar("deform", {0.02, 0.03});
  }
  const Ended both = moduli(
      {table_folder().string(), "--viscosity-mPas", "15", "--min", "index=100", (folder_.path() / "M2.rtdc").string()});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_NE(both.err.find("M2.rtdc: has neither contours nor masks"), std::string::npos) << both.err;
}

/// Of E 1.8 kPa, a cortex with as much over the radius and 0.25 of it as tension.
void expect_effective_modulus(const nlohmann::json& summary, const std::map<std::string, std::string>& row,
                              const std::string& printed) {
  const double truth = effective_modulus<double>({1.8, 1.8, 0.5, 0.45, 0, 1});
  EXPECT_LT(summary.at("effective_modulus_median_kPa_low"), truth);
  EXPECT_LT(truth, summary.at("effective_modulus_median_kPa_high"));
  EXPECT_NEAR(summary.at("median_cell").at("effective_modulus_kPa").get<double>() / truth, 1, 0.15);
  EXPECT_NEAR(std::stod(row.at("effective_modulus_kPa")), truth, 4 * std::stod(row.at("effective_modulus_kPa_error")));
  EXPECT_NE(printed.find(" kPa (median; bulk, cortex and tension together)\n"), std::string::npos) << printed;
}

TEST_F(ModuliCommand, ARecordingOfElongatedCellsHasOneTension) {
  // 1000 Pa at twice the table's viscosity, found from forty pictures within a tenth; the tension stands in the table
  // of events and on the terminal, over the wall's shear stress (eq:wall-stress: 466.8 Pa), and can be given.
  const CombinedTable& elongated = whole_elongated_table();
  const fs::path folder = folder_.path() / "elongated";
  fs::create_directory(folder);
  write_file(folder / "spec.toml", to_toml(elongated.spec));
  write_file(folder / combined_table_name(elongated.spec), combined_table_csv(elongated));
  write_recording(recording(), invented_elongated_outline({6.7, 0.5, 0.25, 0.5 / 1.8}, 1.8));
  const Ended found = moduli({folder.string(), "--viscosity-mPas", "12"});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const auto at = found.out.find("axial tension: ");
  ASSERT_NE(at, std::string::npos) << found.out;
  EXPECT_NEAR(std::stod(found.out.substr(at + 15)), 1000, 100) << found.out;
  EXPECT_NE(found.out.find("of the wall's shear stress of 466.8 Pa"), std::string::npos) << found.out;
  EXPECT_NE(found.out.find("slopes between "), std::string::npos) << found.out;
  EXPECT_NE(table().find("\n# axial tension: "), std::string::npos);
  EXPECT_NE(table().find("\n# slopes between "), std::string::npos);
  double stiffness = 0;
  const auto rows = rows_of(table());
  for (const auto& row : rows) stiffness += std::stod(row.at("stiffness_kPa")) / double(rows.size());
  EXPECT_NEAR(stiffness / 3.6, 1, 0.1);
  const auto summary = nlohmann::json::parse(content_of(folder_.path() / "M1_moduli.json"));
  EXPECT_NEAR(summary.at("axial_tension_Pa").get<double>(), 1000, 100);
  EXPECT_LT(summary.at("axial_tension_Pa_low"), summary.at("axial_tension_Pa_high"));
  EXPECT_EQ(summary.at("slopes_between_cells").size(), 3U);
  EXPECT_NEAR(summary.at("stiffness_median_kPa").get<double>() / 3.6, 1, 0.1);
  EXPECT_LT(summary.at("stiffness_median_kPa_low"), summary.at("stiffness_median_kPa"));
  EXPECT_LT(summary.at("stiffness_median_kPa"), summary.at("stiffness_median_kPa_high"));
  EXPECT_NE(found.out.find(", the median of the population of "), std::string::npos) << found.out;
  expect_effective_modulus(summary, rows[0], found.out);
  // Gates that leave no event, and a tension that no cell of the table has.
  const Ended none = moduli({folder.string(), "--viscosity-mPas", "12", "--min", "index=100"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("no event inside the gates has the shape"), std::string::npos) << none.err;
  const Ended impossible = moduli({folder.string(), "--viscosity-mPas", "12", "--axial-tension-Pa", "-10000"});
  EXPECT_EQ(impossible.exit_code, 3);
  EXPECT_NE(impossible.out.find("40 outside-table"), std::string::npos) << impossible.out;
  const auto& median = summary.at("median_cell");
  EXPECT_EQ(median.at("cells"), events);
  EXPECT_NEAR(median.at("stiffness_kPa").get<double>() / 3.6, 1, 0.15);
  for (const auto& feature : median.at("features")) {
    const double error = feature.at("measured_error");
    EXPECT_NEAR(feature.at("measured").get<double>(), feature.at("fitted").get<double>(), 3 * error) << feature;
  }
  const Ended given = moduli({folder.string(), "--viscosity-mPas", "12", "--axial-tension-Pa", "1000"});
  EXPECT_NE(given.out.find("axial tension: 1000 Pa as given"), std::string::npos) << given.out << given.err;
  // The median's error contains that of a tension that was found.
  const auto with_given = nlohmann::json::parse(content_of(folder_.path() / "M1_moduli.json"));
  const auto error_of = [](const auto& s) { return s.at("stiffness_median_kPa_error").template get<double>(); };
  EXPECT_GT(error_of(summary), 1.2 * error_of(with_given));
  expect_refusal({table_folder().string(), "--axial-tension-Pa", "400"}, "needs a table of elongated cells");
  EXPECT_NE(moduli({folder.string(), "--viscosity-mPas", "12", "--axial-tension", "1000", "--min", "index=100000"})
                .err.find("--axial-tension is now called --axial-tension-Pa; this version still reads the old name"),
            std::string::npos);
}

TEST_F(ModuliCommand, TheOrderOfTheEventsDoesNotChangeADigit) {
  // Forty different cells of the program's table, and the same in reverse: the tension of all, and the row of each.
  const fs::path made = folder_.path() / "made.rtdc";
  const Ended synth = run({{RHEOCYTE, "synth", EXAMPLES "/recordings/combined-cells.toml", "-o", made.string(), "--set",
                            "recording.cells=40"}});
  ASSERT_EQ(synth.exit_code, 0) << synth.err;
  const Recording original(made);
  const ImageSize size = original.image_size("mask").value();
  std::vector<std::uint8_t> masks(original.events() * size.pixels());
  original.read_images("mask", 0, original.events(), masks);
  const auto told = [&] {
    {
      RecordingWriter writer(recording());
      write_usual_metadata(writer);
      writer.images("mask", masks, size.height, size.width);
    }
    const Ended ended =
        run({{RHEOCYTE, "moduli", recording().string(), "--section", "tube", "--viscosity-mPas", "15"}});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    auto rows = rows_of(table());
    for (auto& row : rows) row.erase("event");
    const auto summary = nlohmann::json::parse(content_of(folder_.path() / "M1_moduli.json"));
    return std::tuple(rows, summary.at("axial_tension_Pa"), summary.at("axial_tension_Pa_low"));
  };
  const auto [there, tension, low] = told();
  const auto pixels = std::ptrdiff_t(size.pixels());
  for (auto a = masks.begin(), b = masks.end() - pixels; a < b; a += pixels, b -= pixels)
    std::swap_ranges(a, a + pixels, b);
  auto [back, tension_back, low_back] = told();
  std::ranges::reverse(back);
  EXPECT_EQ(there, back);
  EXPECT_EQ(tension, tension_back);
  EXPECT_EQ(low, low_back);
  EXPECT_TRUE(tension.is_number() && low.is_number()) << tension;
}

TEST_F(ModuliCommand, WithoutATableThatOfTheProgramIsTaken) {
  const Ended ended = run({{RHEOCYTE, "moduli", recording().string(), "--viscosity-mPas", "15"}});
  EXPECT_NE(table().find("\n# table: HC-2D-NH-26\n"), std::string::npos) << ended.err;
  EXPECT_EQ(nlohmann::json::parse(content_of(folder_.path() / "M1_moduli.json")).at("table"), "HC-2D-NH-26");
}

TEST_F(ModuliCommand, CellsThatMoveTowardsSmallerXHaveTheSameModuli) {
  const Eigen::MatrixX2d outline = invented_outline({7, 0.5, 0}, 1.2);
  const auto median_stiffness = [&] {
    EXPECT_EQ(moduli({table_folder().string(), "--viscosity-mPas", "15"}).exit_code, 0);
    return nlohmann::json::parse(content_of(folder_.path() / "M1_moduli.json")).at("stiffness_median_kPa");
  };
  const double there = median_stiffness();
  EXPECT_NE(table().find("\n# direction of the cells: +x"), std::string::npos);
  write_recording(recording(), outline * Eigen::DiagonalMatrix<double, 2>(-1, 1));
  const double back = median_stiffness();
  EXPECT_NE(table().find("\n# direction of the cells: -x"), std::string::npos);
  EXPECT_NEAR(back / there, 1, 0.03);
}

TEST_F(ModuliCommand, WhatCannotBeUsedIsRefused) {
  // One sentence and exit code 2: no table, bad values, options that only `rheocyte extract` can follow, a file of the
  // user's in the place of the result.
  const std::string folder = table_folder().string();
  expect_refusal({(folder_.path() / "none").string()}, "there is no such file or folder");
  expect_refusal({folder, "--viscosity-mPas", "-1"}, "--viscosity-mPas -1 is outside its range");
  expect_refusal({folder, "--pixel-size-um", "0"}, "--pixel-size-um 0 is outside its range");
  for (const std::string option : {"--no-pixelation", "--no-area-correction", "--no-tsv"})
    expect_refusal({folder, option}, option);
  write_file(folder_.path() / "M1_moduli.tsv", "my own notes");
  expect_refusal({folder, "--min", "index=100"}, "move it away, or name another folder with -o");
  EXPECT_EQ(table(), "my own notes");
  fs::remove(folder_.path() / "M1_moduli.tsv");
  write_file(folder_.path() / "M1_moduli.json", "my own notes");
  expect_refusal({folder, "--min", "index=100"}, "move it away, or name another folder with -o");
}

}  // namespace
}  // namespace rheocyte::test::moduli_test
