// `rheocyte synth`: a spec becomes a recording that the other commands take, or one sentence.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "measurement/recording.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"
#include "robustness/run_program.h"
#include "synth/analytic_branches.h"
#include "table/invented_combined.h"
#include "table/table_folder.h"

namespace rheocyte::synth_test {
namespace {

namespace fs = std::filesystem;

class Synth : public testing::Test {
 protected:
  Synth() {
    test::write_file(folder_ / "spec.toml",
                     "[recording]\ncells = 400\npictures = \"none\"\n[channel]\nwidth_um = 20\n[flow]\n"
                     "rate_ul_per_s = 0.04\nviscosity_mPas = 15\n[cell]\nradius_um = {mean = 6, sd = 0.4}\n"
                     "bulk.young_modulus_kPa = 4\n");
  }
  test::Ended run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{RHEOCYTE};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return test::run({all});
  }
  void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) const {
    test::expect_sentence(run(arguments), words);
  }
  std::vector<double> column(const std::string& name, const std::string& feature) const {
    const Recording recording(folder_ / name);
    std::vector<double> values(recording.events());
    recording.read_scalar(feature, 0, values);
    return values;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  test::ScratchFolder folder_;
};

TEST_F(Synth, ModuliOfAVirtualRecordingAreThoseOfItsCells) {
  ASSERT_EQ(run({"synth", path("spec.toml"), "-o", path("v.rtdc"), "--set", "shapes.model=analytical"}).exit_code, 0);
  ASSERT_EQ(run({"analytic", "table", "-o", path("table")}).exit_code, 0);
  const auto table = fs::directory_iterator(folder_ / "table")->path().string();
  const auto ended = run({"extract", path("v.rtdc"), "--table", table, "--viscosity-mPas", "15"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  auto moduli = column("v_rheocyte.rtdc", "emodulus");
  std::erase_if(moduli, [](double value) { return std::isnan(value); });
  ASSERT_GT(moduli.size(), 350U);
  std::ranges::sort(moduli);
  // Areas are measured 3 % too small, which makes moduli 1 to 4 % too small; 400 cells scatter by 10 % each.
  EXPECT_NEAR(moduli[moduli.size() / 2], 4, 0.05 * 4);
}

TEST_F(Synth, SaysWhatItMadeAndWhatItLeftOut) {
  test::write_file(
      folder_ / "soft.toml",
      "[recording]\ncells = 100\n[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\n"
      "viscosity_mPas = 15\n[cell]\nradius_um = {mean = 6, sd = 0.4}\n"
      "bulk.young_modulus_kPa = {mean = 5, sd = 1}\n[shapes]\nmodel = \"analytical\"\nmax_deformation = 0.01\n");
  const auto ended = run({"synth", path("soft.toml"), "-o", path("v.rtdc")});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find(" events; areas measured -"), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("of 100 cells are left out: too soft."), std::string::npos) << ended.err;
}

/// So many cells of 1.2 kPa, with a spread of the modulus (kPa).
std::string solids_in_cellcarrier(int cells, double modulus_sd_kPa) {
  return fmt::format(
      "[recording]\ncells = {}\n[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\nmedium = \"CellCarrier\"\n"
      "[cell]\nradius_um = {{mean = 6.2, sd = 0.4}}\nbulk.young_modulus_kPa = {{mean = 1.2, sd = {}}}\n",
      cells, modulus_sd_kPa);
}

TEST_F(Synth, WithoutATableModuliComeBackByTheTableOfTheirShapes) {
  test::write_file(folder_ / "default.toml", solids_in_cellcarrier(300, 0.15));
  for (const std::string table : {"", "LE-2D-MC049-26"}) {
    std::vector<std::string> command{"synth", path("default.toml"), "-o", path("v.rtdc"), "--force"}, section;
    if (!table.empty()) {
      command.insert(command.end(), {"--set", "shapes.table=" + table});
      section = {"--section", "tube"};
    }
    const auto made = run(command);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    std::vector<std::string> reading{"extract", path("v.rtdc")};
    reading.insert(reading.end(), section.begin(), section.end());
    const auto ended = run(reading);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const std::string cells = table.empty() ? "neo-Hookean solids in the square channel" : "linear solids in the tube";
    EXPECT_NE(ended.out.find("made by rheocyte synth from " + cells + "; the table " +
                             (table.empty() ? "HE-3D-MC049-26" : table) + " fits."),
              std::string::npos)
        << ended.out;
    EXPECT_NE(ended.out.find("the shapes are those of the model, " + cells), std::string::npos) << ended.out;
    const auto found = column("v_rheocyte.rtdc", "emodulus"), truth = column("v.rtdc", "userdef2");
    std::vector<double> ratio;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (std::isfinite(found[i])) ratio.push_back(found[i] / truth[i]);
    ASSERT_GT(ratio.size(), 280U) << ended.out;
    std::ranges::sort(ratio);
    // 300 cells with 6 % each by pixels leave 0.4 % of the median, the law of the pixels some more.
    EXPECT_NEAR(ratio[ratio.size() / 2], 1, 0.015) << cells;
  }
  const auto by_another = run({"extract", path("v.rtdc")});
  EXPECT_NE(by_another.out.find("the table LE-2D-MC049-26 fits, the moduli given here are from HE-3D-MC049-26."),
            std::string::npos)
      << by_another.out;
}

/// The ratio of the recommended modulus to that of all cells, and its errors in parts of it.
struct RecommendedRatio {
  double ratio, scatter, common;
  std::string warnings;
};

TEST_F(Synth, GatesOnTheShapeAreAnErrorOfTheRecommendedModulus) {
  test::write_file(folder_ / "cells.toml", solids_in_cellcarrier(400, 0.3));
  ASSERT_EQ(run({"synth", path("cells.toml"), "-o", path("v.rtdc")}).exit_code, 0);
  const auto recommended = [&](const std::vector<std::string>& gates) {
    std::vector<std::string> command{"extract", path("v.rtdc"), "-o", path("out")};
    command.insert(command.end(), gates.begin(), gates.end());
    const auto ended = run(command);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto lines = split(test::content_of(folder_ / "out" / "rheocyte_summary.tsv"), '\n');
    const auto names = split(lines[0], '\t'), values = split(lines[1], '\t');
    const auto number = [&](const std::string& name) {
      return std::stod(values.at(std::size_t(std::ranges::find(names, name) - names.begin())));
    };
    const std::string name = "recommended_young_modulus_median_kPa";
    return RecommendedRatio{number(name), number(name + "_error"), number(name + "_common_error"), ended.err};
  };
  const RecommendedRatio all = recommended({});
  EXPECT_NEAR(all.ratio, 1.2, 0.1);
  for (const std::vector<std::string>& gates :
       {std::vector<std::string>{"--max", "deform=0.024"},
        {"--polygon", "area_um,deform=40,0.03:200,0.03:200,0.1:40,0.1", "--max", "area_um=300"}}) {
    const RecommendedRatio selected = recommended(gates);
    const double off = std::abs(selected.ratio - all.ratio);
    EXPECT_GT(off, 5 * std::hypot(selected.scatter, all.scatter)) << "the selection matters";
    EXPECT_GT(selected.common, 0.8 * off);
    EXPECT_NE(selected.warnings.find("select cells by their shape"), std::string::npos) << selected.warnings;
  }
  const RecommendedRatio wide = recommended({"--max", "deform=0.2", "--min", "area_um=60"});
  EXPECT_EQ(wide.ratio, all.ratio);
  EXPECT_EQ(wide.warnings.find("select cells by their shape"), std::string::npos) << wide.warnings;
}

TEST_F(Synth, WithAnAxialTensionAloneTheCellsAreThoseOfTheTableOfElongatedOnesThatReadsThem) {
  test::write_file(folder_ / "drawn.toml",
                   "[recording]\ncells = 300\n[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\n"
                   "viscosity_mPas = 6\naxial_tension_Pa = 300\n[cell]\nradius_um = {mean = 6.2, sd = 0.3}\n"
                   "bulk.young_modulus_kPa = {mean = 2, sd = 0.1}\n");
  ASSERT_EQ(run({"synth", path("drawn.toml"), "-o", path("v.rtdc")}).exit_code, 0);
  const auto ended = run({"extract", path("v.rtdc")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto behind = [&](const std::string& words) {
    const auto at = ended.out.find(words);
    return std::istringstream(at == std::string::npos ? "" : ended.out.substr(at + words.size()));
  };
  double modulus = 0, by_scatter = 0, in_common = 0, tension = 0;
  std::string sign;
  behind("report E = ") >> modulus >> sign >> by_scatter >> sign >> in_common;
  behind("axial tension of ") >> tension;
  // Without the 6 % for cells off the axis in height, which virtual ones are not, the line would state 0.03.
  EXPECT_NEAR(modulus, 2, 0.06) << ended.out;
  EXPECT_LT(by_scatter, 0.02) << ended.out;
  EXPECT_NEAR(in_common, std::hypot(0.06, 0.026) * modulus, 0.005) << ended.out;
  EXPECT_NEAR(tension, 300, 15) << ended.out;
  EXPECT_NE(
      ended.out.find("made by rheocyte synth from neo-Hookean solids in the square channel under an axial tension; "
                     "the table of elongated cells fits."),
      std::string::npos)
      << ended.out;
}

TEST_F(Synth, CellsThatAreLongAtRestNeedATableOfSuchCells) {
  const std::vector<std::string> command{"synth", path("spec.toml"), "-o", path("v.rtdc")};
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> all = command;
    all.insert(all.end(), {"--set", setting, "--set", "shapes.table=HE-3D-el-26"});
    return all;
  };
  expect_refusal(with("cell.rest_aspect=1.3"), "cell.rest_aspect needs a table with table.elongated_by");
  std::vector<std::string> without_table = command;
  without_table.insert(without_table.end(), {"--set", "cell.rest_aspect=1.3"});
  expect_refusal(without_table, "cell.rest_aspect needs a table with table.elongated_by");
}

TEST_F(Synth, LinearSolidsAreNotAccusedOfBeingLongerThanElasticCells) {
  // A recording of linear solids in the tube that does not say so.
  const fs::path recording = test::reference_folder().parent_path() / "cases/virtual.rtdc";
  if (!fs::exists(recording)) GTEST_SKIP() << "there is no " << recording;
  const auto square = run({"extract", recording.string(), "-o", path("out")});
  ASSERT_EQ(square.exit_code, 0) << square.err;
  EXPECT_NE(square.out.find("not those of neo-Hookean solids in the square channel"), std::string::npos) << square.out;
  EXPECT_NE(square.out.find("but those of linear solids in the tube"), std::string::npos) << square.out;
  EXPECT_NE(square.out.find("too high, take the table LE-2D-MC049-26."), std::string::npos) << square.out;
  const auto tube = run({"extract", recording.string(), "-o", path("out"), "--section", "tube"});
  EXPECT_NE(tube.out.find("the shapes are those of the model, linear solids in the tube"), std::string::npos)
      << tube.out;
  const auto large = run({"extract", recording.string(), "-o", path("out"), "--pixel-size-um", "0.68"});
  for (const auto& ended : {square, tube, large}) EXPECT_EQ(ended.out.find("factor"), std::string::npos) << ended.out;
}

TEST_F(Synth, ATableInPlaceOfTheClosedModelIsLookedForBesideTheSpec) {
  const std::string flow =
      "[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\nviscosity_mPas = 15\n[cell]\nradius_um = 6\n"
      "bulk.young_modulus_kPa = 4\n[shapes]\ntable = \"table\"\n";
  test::write_file(folder_ / "spec.toml", flow);
  expect_refusal({"synth", path("spec.toml"), "-o", path("v.rtdc")}, path("table") + ": there is no table");
  const std::string of_shells =
      "channel.width_um = 20\nflow.rate_ul_per_s = 0.04\nflow.viscosity_mPas = 15\ncell.bulk.law = \"none\"\n"
      "cell.cortex.law = \"linear\"\n[table]\nidentifier = \"SHELL\"\nstiffness = "
      "\"cell.cortex.modulus_mN_per_m\"\n";
  fs::create_directories(folder_ / "table");
  test::write_file(folder_ / "table/spec.toml", of_shells);
  expect_refusal({"synth", path("spec.toml"), "-o", path("v.rtdc")}, "contains other files");
}

TEST_F(Synth, CellsOfAComputedTableHaveItsShapes) {
  const auto spec = parse_table_spec(
      "channel.width_um = 20\nflow.rate_ul_per_s = 0.04\nflow.viscosity_mPas = 15\n[table]\nidentifier = \"CLOSED\"\n"
      "stiffness = \"cell.bulk.young_modulus_kPa\"\nmin_area_um2 = 45\nmax_area_um2 = 190\nradii = 12\n",
      "table");
  const TableFolder folder(folder_ / "table", spec);
  for (int i = 0; i < folder.branches(); ++i) folder.keep(i, test::analytic_branch(folder.place(i).radius_um), false);
  test::write_file(folder_ / "spec.toml",
                   test::content_of(folder_ / "spec.toml") + "[noise]\nlateral_um = 0\n[shapes]\n");
  ASSERT_EQ(run({"synth", path("spec.toml"), "-o", path("closed.rtdc"), "--set", "shapes.model=analytical"}).exit_code,
            0);
  test::write_file(folder_ / "spec.toml", test::content_of(folder_ / "spec.toml") + "table = \"table\"\n");
  const auto ended = run({"synth", path("spec.toml"), "-o", path("table.rtdc")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto closed = column("closed.rtdc", "userdef4"), table = column("table.rtdc", "userdef4");
  ASSERT_EQ(closed.size(), table.size());
  // Cubics between twelve radii.
  for (std::size_t i = 0; i < closed.size(); ++i) EXPECT_NEAR(table[i], closed[i], 3e-3 * closed[i]);
}

/// A combined table as `rheocyte table` leaves it, of invented cells.
void write_combined_table(const fs::path& path, const std::string& spec_text) {
  const TableFolder folder(path, parse_table_spec(spec_text, "table"));
  CombinedTable table{folder.spec(), {}};
  for (int i = 0; i < folder.branches(); ++i) {
    folder.keep(i, test::invented_combined_samples(folder.place(i)), false);
    table.branches.push_back(test::invented_combined_branch(folder.place(i)));
  }
  folder.publish(combined_table_name(table.spec), combined_table_csv(table));
}

const std::string combined_cells =
    "[recording]\ncells = 60\npixel_size_um = 0.1\nwidth_px = 260\n[channel]\nwidth_um = 20\n[flow]\n"
    "rate_ul_per_s = 0.04\nviscosity_mPas = 30\n[shapes]\ntable = \"table\"\n[cell]\nkind = \"combined\"\n"
    "radius_um = {mean = 6.8, sd = 0.3}\nbulk.young_modulus_kPa = {mean = 2, sd = 0.3}\n"
    "cortex.modulus_mN_per_m = {mean = 12, sd = 2, distribution = \"lognormal\"}\n";

std::string without_tension() {
  std::string text = test::combined_spec;
  const std::string ratios = "tension_ratio = [0, 0.15, 0.3]\n";
  return text.erase(text.find(ratios), ratios.size());
}

TEST_F(Synth, ModuliOfCombinedCellsAreThoseOfTheirTruth) {
  // The whole way through a table of one tension (none), whose cells are those of the tube: pixels of 0.1 um and 60
  // cells leave a few percent of the mean.
  write_combined_table(folder_ / "table", without_tension());
  test::write_file(folder_ / "combined.toml", combined_cells);
  const auto made = run({"synth", path("combined.toml"), "-o", path("v.rtdc")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto young = column("v.rtdc", "userdef2"), cortex = column("v.rtdc", "userdef7");
  ASSERT_GE(young.size(), 58U) << made.err;
  EXPECT_EQ(column("v.rtdc", "userdef8"), std::vector<double>(young.size(), 0));
  const Recording recording(folder_ / "v.rtdc");
  EXPECT_EQ(recording.metadata().text("user:rheocyte userdef7"), "true cortex modulus E2D (mN/m)");
  const auto ended = run({"moduli", path("v.rtdc"), "--table", path("table")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("from cells of the table: the channel is that of the table"), std::string::npos)
      << ended.err;
  std::istringstream lines(test::content_of(folder_ / "v_moduli.tsv"));
  std::size_t event = 0;
  double young_ratio = 0, cortex_ratio = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with("event")) continue;
    std::istringstream fields(line);
    std::vector<double> numbers(13);
    for (double& number : numbers) fields >> number;
    ASSERT_LT(event, young.size());
    young_ratio += numbers[4] / young[event] / double(young.size());
    cortex_ratio += numbers[6] / cortex[event] / double(young.size());
    ++event;
  }
  EXPECT_EQ(event, young.size());
  EXPECT_NEAR(young_ratio, 1, 0.05);
  EXPECT_NEAR(cortex_ratio, 1, 0.05);
}

TEST_F(Synth, TensionsOfCombinedCellsHaveASpreadOfTheirOwn) {
  write_combined_table(folder_ / "table", test::combined_spec);
  test::write_file(folder_ / "combined.toml", combined_cells + "cortex.tension_mN_per_m = {mean = 1.8, sd = 0.3}\n");
  const auto made = run({"synth", path("combined.toml"), "-o", path("v.rtdc")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto tension = column("v.rtdc", "userdef8");
  const auto [least, greatest] = std::ranges::minmax(tension);
  EXPECT_LT(least, 1.5);
  EXPECT_GT(greatest, 2.1);
  test::write_file(folder_ / "tense.toml", combined_cells + "cortex.tension_ratio = 0.5\n");
  expect_refusal({"synth", path("tense.toml"), "-o", path("w.rtdc")}, "60 of a cortex or tension outside the table");
}

TEST_F(Synth, CellsAndTheirTableMustGoTogether) {
  // Kind and tension must be those of the table; each mistake is one sentence that names the way out.
  write_combined_table(folder_ / "table", test::combined_spec);
  write_combined_table(folder_ / "one-tension", without_tension());
  const auto expect = [&](const std::string& text, const std::string& words) {
    test::write_file(folder_ / "bad.toml", text);
    expect_refusal({"synth", path("bad.toml"), "-o", path("v.rtdc")}, words);
  };
  expect(combined_cells,
         "has the tensions 0, 0.15, 0.3 in E2D; give cell.cortex.tension_ratio or cell.cortex.tension_mN_per_m");
  const auto replaced = [](std::string text, const std::string& old, const std::string& by) {
    return text.replace(text.find(old), old.size(), by);
  };
  expect(replaced(combined_cells, "\"table\"", "\"one-tension\"") + "cortex.tension_ratio = 0.1\n",
         "all its cells have the tension 0 E2D; remove cell.cortex.tension_ratio");
  const std::string solids = test::content_of(folder_ / "spec.toml") + "[shapes]\ntable = \"table\"\n";
  expect(solids, "cell.kind must be \"combined\"");
}

TEST_F(Synth, WhatIsWrongIsSaidAndLeavesNothing) {
  const std::string spec = path("spec.toml");
  expect_refusal({"synth", spec}, "--output is required");
  expect_refusal({"synth", path("none.toml"), "-o", path("v.rtdc")}, "none.toml");
  expect_refusal({"synth", spec, "-o", path("v.h5")}, "end in .rtdc");
  expect_refusal({"synth", spec, "-o", path("nowhere/v.rtdc")}, "there is no such folder");
  test::write_file(folder_ / "precious.rtdc", "a real one");
  expect_refusal({"synth", spec, "-o", path("precious.rtdc")}, "already exists");
  EXPECT_EQ(test::content_of(folder_ / "precious.rtdc"), "a real one");
  test::write_file(folder_ / "wrong.toml", "[recording]\ncells = 10\nseeds = 2\n");
  expect_refusal({"synth", path("wrong.toml"), "-o", path("v.rtdc")},
                 "wrong.toml:3: unknown key recording.seeds = 2, did");
  test::write_file(
      folder_ / "soft.toml",
      "[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\nviscosity_mPas = 15\n[cell]\nradius_um = 6\n"
      "bulk.young_modulus_kPa = 0.1\n");
  expect_refusal({"synth", path("soft.toml"), "-o", path("v.rtdc")}, "500 too soft");
  for (const auto& entry : fs::directory_iterator(folder_ / "."))
    EXPECT_FALSE(entry.path().filename().string().starts_with('.') || entry.path().filename() == "v.rtdc")
        << entry.path();
}

TEST_F(Synth, AFullDiskLeavesNoTornFile) {
  const auto ended = test::run({{RHEOCYTE, "synth", path("spec.toml"), "-o", path("v.rtdc")}, {}, 4000});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_NE(ended.err.find("cannot be written"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("/v.rtdc: "), std::string::npos) << ended.err;  // not the hidden name
  for (const auto& entry : fs::directory_iterator(folder_ / "."))
    EXPECT_EQ(entry.path().filename(), "spec.toml") << entry.path();
}

}  // namespace
}  // namespace rheocyte::synth_test
