// `rheocyte analytic`: answers at once, writes whole files only, never over the user's own, and names every mistake.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "run_program.h"

namespace rheocyte::test::analytic_command_test {
namespace {

namespace fs = std::filesystem;

Ended analytic(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {RHEOCYTE, "analytic"});
  return run({arguments});
}

void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) {
  expect_sentence(analytic(arguments), words);
}

std::vector<std::string> solid(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"cell", "--radius-um", "5.47", "--young-modulus-kPa", "20"});
  return more;
}

struct Row {
  double area_um2, deformation, modulus_kPa;
};

// Rows of a table in dclab's format; the last comment must be the header of the three columns.
std::vector<Row> rows_of(const fs::path& file) {
  std::istringstream text(content_of(file));
  std::vector<Row> rows;
  std::string comment;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with('#')) {
      EXPECT_TRUE(rows.empty()) << line;
      comment = line;
      continue;
    }
    Row row{};
    EXPECT_TRUE(std::istringstream(line) >> row.area_um2 >> row.deformation >> row.modulus_kPa) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), '\t'), 2) << line;
    rows.push_back(row);
  }
  EXPECT_EQ(comment, "# area_um [um^2]\tdeform\temodulus [kPa]");
  return rows;
}

// The JSON object between the marks that dclab looks for.
nlohmann::json metadata_of(const fs::path& file) {
  const std::string text = content_of(file);
  const auto begin = text.find("# BEGIN METADATA\n"), end = text.find("# END METADATA\n");
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::istringstream lines(text.substr(begin + 17, end - begin - 17));
  std::string json;
  for (std::string line; std::getline(lines, line);) json += line.substr(1);
  return nlohmann::json::parse(json, nullptr, false);
}

TEST(AnalyticCommand, ACellHasTheNumbersOfTheModel) {
  // lambda = 0.5: U / u_max = 0.8399233708, dp R^3 / (eta Q) = 0.1661065694, d / Ca^2 = 0.641486625 for Ca -> 0.
  const auto ended = analytic(solid({"--json"}));
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto json = nlohmann::json::parse(ended.out);
  const double R = 10.94e-6, Q = 0.04e-9, eta = 15e-3, capillary = eta * Q / (R * R * R) / 20e3;
  EXPECT_NEAR(json["capillary_number"].get<double>() / capillary, 1, 1e-12);
  EXPECT_NEAR(json["leading_deformation"].get<double>() / (0.641486625 * capillary * capillary), 1, 1e-8);
  EXPECT_NEAR(json["deformation"].get<double>() / json["leading_deformation"].get<double>(), 1, 1e-4);
  EXPECT_NEAR(json["cell_velocity_m_per_s"].get<double>() / (0.8399233708 * 2 * Q / (M_PI * R * R)), 1, 1e-9);
  EXPECT_NEAR(json["additional_pressure_drop_Pa"].get<double>() / (0.1661065694 * eta * Q / (R * R * R)), 1, 1e-9);
  EXPECT_TRUE(json["within_limits"].get<bool>());
}

TEST(AnalyticCommand, AShellHasTheNumbersOfTheModel) {
  // lambda = 0.5, gamma = 0.1 E2D: d / Ca^2 = 0.18930304 for Ca -> 0, Ca = eta Q / (R^2 E2D).
  const auto ended = analytic({"cell", "--radius-um", "5.47", "--cortex-modulus-mN-m", "200", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto json = nlohmann::json::parse(ended.out);
  const double capillary = 15e-3 * 0.04e-9 / (10.94e-6 * 10.94e-6) / 0.2;
  EXPECT_NEAR(json["capillary_number"].get<double>() / capillary, 1, 1e-12);
  EXPECT_NEAR(json["leading_deformation"].get<double>() / (0.18930304 * capillary * capillary), 1, 1e-7);
  EXPECT_EQ(json["tension_ratio"].get<double>(), 0.1);
}

TEST(AnalyticCommand, WidthAndRadiusMeanTheSameTube) {
  // A square channel of 20 um stands for a tube of radius 10.94 um.
  EXPECT_EQ(analytic(solid()).out, analytic(solid({"--channel-width-um", "20"})).out);
  EXPECT_EQ(analytic(solid()).out, analytic(solid({"--tube-radius-um", "10.94"})).out);
  EXPECT_NE(analytic(solid()).out, analytic(solid({"--square-duct"})).out);
}

TEST(AnalyticCommand, LimitsOfTheModelAreRemarked) {
  // Deformations above 0.02 (shells: 0.001) and radii above 0.8 of the tube's are said to be beyond the model.
  EXPECT_EQ(analytic(solid()).out.find("remark"), std::string::npos);
  const auto soft = analytic({"cell", "--radius-um", "6", "--young-modulus-kPa", "2"});
  EXPECT_NE(soft.out.find("d up to 0.02"), std::string::npos) << soft.out;
  const auto shell = analytic({"cell", "--radius-um", "6", "--cortex-modulus-mN-m", "50"});
  EXPECT_NE(shell.out.find("d up to 0.001"), std::string::npos) << shell.out;
  const auto large = analytic({"cell", "--radius-um", "9", "--young-modulus-kPa", "40"});
  EXPECT_NE(large.out.find("r0 up to 0.8 tube radii"), std::string::npos) << large.out;
}

TEST(AnalyticCommand, TheContourIsWrittenFromPoleToPole) {
  // 721 points and a header, both ends on the axis; an older contour is replaced, and nothing else is left behind.
  const TemporaryFolder folder;
  const auto file = folder.path() / "new" / "contour.csv";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(analytic(solid({"-o", file})).exit_code, 0);
  const std::string text = content_of(file);
  EXPECT_TRUE(text.starts_with("x_um,r_um\n"));
  EXPECT_TRUE(text.ends_with(",0\n"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 722);
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

TEST(AnalyticCommand, TheTableIsWhatDclabReads) {
  // Keys with their units, three columns, deformations up to the limit, and the same bytes each time.
  const TemporaryFolder folder;
  ASSERT_EQ(analytic({"table", "-o", folder.path()}).exit_code, 0);
  const auto file = folder.path() / "lut_LE-2D-ANA-26.txt";
  const auto metadata = metadata_of(file);
  ASSERT_TRUE(metadata.is_object());
  EXPECT_EQ(metadata["identifier"], "LE-2D-ANA-26");
  EXPECT_EQ(metadata["channel_width"], 20.0);
  EXPECT_EQ(metadata["channel_width_unit"], "um");
  EXPECT_EQ(metadata["flow_rate"], 0.04);
  EXPECT_EQ(metadata["flow_rate_unit"], "uL/s");
  EXPECT_EQ(metadata["fluid_viscosity"], 15.0);
  EXPECT_EQ(metadata["fluid_viscosity_unit"], "mPa s");
  const auto rows = rows_of(file);
  EXPECT_GT(rows.size(), 2000U);
  for (const Row& row : rows) EXPECT_TRUE(row.deformation > 0 && row.deformation <= 0.02 && row.area_um2 > 3);
  const std::string before = content_of(file);
  EXPECT_EQ(analytic({"table", "-o", folder.path()}).exit_code, 0);
  EXPECT_EQ(content_of(file), before);
  EXPECT_TRUE(std::all_of(before.begin(), before.end(), [](unsigned char c) { return c < 0x80; }));
}

TEST(AnalyticCommand, LinesOfTheSquareDuctPassThroughThePublishedPoint) {
  // First point of the published lines: lambda = 0.1, 0.93 kPa: 3.75331 um^2, and 5.14496e-3 less 6.6e-8 for the
  // polygon of 5000 points that the published shapes are; six digits are printed.
  const TemporaryFolder folder;
  ASSERT_EQ(analytic({"lines", "--square-duct", "-o", folder.path()}).exit_code, 0);
  const auto file = folder.path() / "iso_LE-2D-ANA-26-duct-area_um-deform.txt";
  EXPECT_EQ(metadata_of(file)["lut identifier"], "LE-2D-ANA-26-duct");
  const auto rows = rows_of(file);
  ASSERT_FALSE(rows.empty());
  EXPECT_NEAR(rows[0].modulus_kPa, 0.93, 1e-12);
  EXPECT_NEAR(rows[0].area_um2 / 3.75331, 1, 1e-5);
  EXPECT_NEAR((rows[0].deformation + 6.6e-8) / 5.14496e-3, 1, 1e-5);
}

TEST(AnalyticCommand, DefaultsScaleWithTheChannel) {
  // Half the width, the same flow rate: areas a quarter, moduli eight times (three digits), deformations as they were.
  const TemporaryFolder folder;
  const auto standard = folder.path() / "standard", small = folder.path() / "small";
  ASSERT_EQ(analytic({"lines", "-o", standard, "--moduli-kPa", "1,2.5"}).exit_code, 0);
  ASSERT_EQ(analytic({"lines", "-o", small, "--moduli-kPa", "8,20", "--channel-width-um", "10"}).exit_code, 0);
  const std::string name = "iso_LE-2D-ANA-26-area_um-deform.txt";
  const auto wide = rows_of(standard / name), narrow = rows_of(small / name);
  ASSERT_EQ(wide.size(), narrow.size());
  for (std::size_t i = 0; i < wide.size(); ++i) {
    EXPECT_NEAR(4 * narrow[i].area_um2 / wide[i].area_um2, 1, 2e-7);  // eight digits are printed
    EXPECT_NEAR(narrow[i].deformation / wide[i].deformation, 1, 2e-7);
  }
  ASSERT_EQ(analytic({"table", "-o", standard}).exit_code, 0);
  ASSERT_EQ(analytic({"table", "-o", small, "--channel-width-um", "10"}).exit_code, 0);
  EXPECT_NEAR(rows_of(small / "lut_LE-2D-ANA-26.txt").back().modulus_kPa, 240, 1e-9);
  EXPECT_NEAR(rows_of(standard / "lut_LE-2D-ANA-26.txt").back().modulus_kPa, 30, 1e-9);
}

TEST(AnalyticCommand, FilesOfOthersAreKept) {
  // A file that does not begin like ours stays, unless --force is given; so does a folder of that name.
  const TemporaryFolder folder;
  const auto file = folder.path() / "lut_LE-2D-ANA-26.txt";
  write_file(file, "precious");
  expect_refusal({"table", "-o", folder.path()}, "was not written by rheocyte");
  expect_refusal(solid({"-o", file}), "was not written by rheocyte");
  EXPECT_EQ(content_of(file), "precious");
  EXPECT_EQ(analytic({"table", "-o", folder.path(), "--force"}).exit_code, 0);
  EXPECT_TRUE(content_of(file).starts_with("# rheocyte "));
  expect_refusal(solid({"-o", file}), "was not written by rheocyte");  // a table is no contour
  expect_refusal(solid({"-o", folder.path(), "--force"}), "is a folder");
  expect_refusal(solid({"-o", "/dev/full", "--force"}), "is not a regular file");
  expect_refusal({"table", "-o", file}, "cannot make its folder");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(AnalyticCommand, AFullDiskLeavesTheOlderFile) {
  // The limit on the size of a file stands for the disk: one sentence, the older table whole, no scratch file.
  const TemporaryFolder folder;
  const auto file = folder.path() / "lut_LE-2D-ANA-26.txt";
  ASSERT_EQ(analytic({"table", "-o", folder.path(), "--radii", "10", "--moduli", "5"}).exit_code, 0);
  const std::string before = content_of(file);
  Command command{{RHEOCYTE, "analytic", "table", "-o", folder.path()}};
  command.max_file_bytes = 8192;
  const auto ended = run(command);
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("an older file is left as it was"), std::string::npos) << ended.err;
  EXPECT_EQ(content_of(file), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(AnalyticCommand, MistakesAreNamed) {
  expect_refusal({}, "subcommand is required");
  expect_refusal({"cell"}, "--radius-um is required");
  expect_refusal({"table"}, "--output is required");
  expect_refusal({"cell", "--radius-um", "6"}, "give either --young-modulus-kPa");
  expect_refusal(solid({"--cortex-modulus-mN-m", "3"}), "give either --young-modulus-kPa");
  expect_refusal(solid({"--tension-ratio", "0.2"}), "is for shells");
  expect_refusal({"cell", "--radius-um", "-3", "--young-modulus-kPa", "3"}, "--radius-um -3 is outside its range");
  expect_refusal({"cell", "--radius-um", "12", "--young-modulus-kPa", "3"}, "0.547 .. 10.56 um");
  expect_refusal({"cell", "--radius-um", "6", "--young-modulus-kPa", "nan"}, "nan is outside its range");
  expect_refusal({"cell", "--radius-um", "6", "--young-modulus-kPa", "x"}, "--young-modulus-kPa = x");
  expect_refusal({"cell", "--radius-um", "6", "--young-modulus-kPa", "0.001"}, "far too soft");
  expect_refusal(solid({"--tube-radius-um", "10", "--channel-width-um", "20"}), "exclude each other");
  expect_refusal(solid({"--tube-radius-um", "10", "--square-duct"}), "give --channel-width-um");
}

TEST(AnalyticCommand, MistakesInTablesAreNamed) {
  const TemporaryFolder folder;
  const auto refuse = [&](std::vector<std::string> arguments, const std::string& words) {
    arguments.insert(arguments.end(), {"-o", folder.path() / "new"});
    expect_refusal(arguments, words);
  };
  refuse({"table", "--least-radius-um", "9"}, "--least-radius-um 9 is not below --greatest-radius-um");
  refuse({"table", "--greatest-radius-um", "12"}, "--greatest-radius-um 12 is outside 0.547 .. 10.56 um");
  refuse({"table", "--greatest-modulus-kPa", "0.1"}, "--least-modulus-kPa 0.5 is not below");
  refuse({"table", "--least-modulus-kPa", "0.01", "--greatest-modulus-kPa", "0.1"}, "larger moduli");
  refuse({"table", "--radii", "1"}, "--radii");
  refuse({"table", "--identifier", "../x"}, "--identifier");
  refuse({"table", "--greatest-deformation", "nan"}, "--max-deformation nan is outside its range");
  refuse({"lines", "--moduli-kPa", "1,nan"}, "--moduli-kPa nan is outside its range");
  EXPECT_FALSE(fs::exists(folder.path() / "new"));
}

}  // namespace
}  // namespace rheocyte::test::analytic_command_test
