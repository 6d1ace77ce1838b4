// `rheocyte population --model cortex` from virtual recordings to the answers.
#include "population_fixture.h"

namespace rheocyte::test::population_test {
namespace {

/// Cells with a cortex, of these means of E (kPa) and E2D (mN/m), by the program's own table.
std::string cells_with_cortex(double young_kPa, double cortex_mN_per_m) {
  return fmt::format(R"([recording]
cells = 500
[channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15
axial_tension_Pa = {{mean = 250}}
[cell]
kind = "combined"
radius_um = {{mean = 6.5, sd = 0.4}}
[cell.bulk]
young_modulus_kPa = {{mean = {}, sd = {}, distribution = "lognormal"}}
[cell.cortex]
modulus_mN_per_m = {{mean = {}, sd = {}, distribution = "lognormal"}}
tension_ratio = {{mean = 0.3, sd = 0.06}}
)",
                     young_kPa, 0.2 * young_kPa, cortex_mN_per_m, 0.2 * cortex_mN_per_m);
}

// A drug that takes a third of the cortex away and leaves the bulk as it is.
TEST_F(PopulationCommand, BulkCortexAndTensionsComeBackAndSoDoesWhatADrugDoes) {
  write_file(folder_.path() / "cortex.toml", cells_with_cortex(2, 10));
  write_file(folder_.path() / "less.toml", cells_with_cortex(2, 6.7));
  synth("control.rtdc", {"recording.seed=1"}, "cortex.toml");
  synth("drug.rtdc", {"recording.seed=2"}, "less.toml");
  const Ended ended =
      call({"population", "--model", "cortex", "--condition", "control=control.rtdc", "--condition", "drug=drug.rtdc"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto all = record();
  EXPECT_EQ(all["model"], "cortex");
  const double below_mean = std::exp(-0.5 * std::log1p(0.04));  // median of a lognormal law
  const auto expect_in = [](const nlohmann::json& row, const std::string& name, double truth, std::string ends = {}) {
    // The interval of 95 % and half as much on either side.
    if (ends.empty()) ends = name;
    const double value = row[name], lower = row[ends + "_low"], upper = row[ends + "_high"];
    EXPECT_GT(truth, lower - (value - lower) / 2) << name << ' ' << value;
    EXPECT_LT(truth, upper + (upper - value) / 2) << name << ' ' << value;
  };
  for (const auto& recording : all["recordings"]) {
    const double cortex = recording["condition"] == "drug" ? 6.7 : 10;
    expect_in(recording, "young_modulus_median_kPa", 2 * below_mean);
    expect_in(recording, "cortex_modulus_median_mN_per_m", cortex * below_mean);
    expect_in(recording, "cortex_tension_median_mN_per_m", 0.3 * cortex * below_mean);
    expect_in(recording, "axial_tension_median_Pa", 250);
    expect_in(recording, "effective_modulus_median_kPa",
              below_mean * effective_modulus<double>({2, cortex, 0.5, 0.3 * cortex, 0, 6.5}));
    EXPECT_NEAR(recording["radius_median_um"], 6.5, 0.1);
    EXPECT_TRUE(recording["bulk_and_cortex_not_told_because"].is_null());
    EXPECT_EQ(recording["section"], "tube") << "of the table's own cells";
    for (const auto& check : recording["checks"]) EXPECT_TRUE(check["fits"]) << check.dump();
  }
  for (const auto& comparison : all["comparisons"])
    if (comparison["quantity"] == "cortex_modulus") expect_in(comparison, "ratio", 0.67, "ratio_by_sampling");
  EXPECT_NE(ended.out.find("drug / control: E2D, ratio 0."), std::string::npos) << ended.out;
  for (const char* const words : {"drug / control: E_eff, ratio 0.", "E_eff: effective Young's modulus, of bulk, "})
    EXPECT_NE(ended.out.find(words), std::string::npos) << ended.out;
  EXPECT_TRUE(fs::exists(folder_.path() / "population" / "population.png")) << ended.err;
  EXPECT_NE(content_of(folder_.path() / "population" / "population.tsv").find("\tcortex_modulus_median_mN_per_m\t"),
            std::string::npos);
  EXPECT_NE(ended.out.find(" % of E2D, "), std::string::npos) << "each quantity has its systematic error";

  // About half of the cells are smaller than that.
  const Ended gated = call({"population", "--model", "cortex", "--condition", "control=control.rtdc", "--min",
                            "area_um=130", "--max", "pos_x=1e9", "--no-picture"});
  ASSERT_EQ(gated.exit_code, 0) << gated.err;
  EXPECT_NE(gated.err.find("the gates on pos_x <= 1000000000 are not part of the model"), std::string::npos);
  const auto kept = record()["recordings"][0];
  EXPECT_NEAR(kept["kept_fraction"], 0.5, 0.15);
  EXPECT_NEAR(kept["radius_median_um"], 6.5, 0.15) << "of all cells; the median of those that are kept is 6.8";
  expect_in(kept, "axial_tension_median_Pa", 250);
  expect_in(kept, "stiffness_median_kPa", 3.4);

  const Ended outside = call({"population", "--model", "cortex", "--condition", "control=control.rtdc",
                              "--channel-width-um", "40", "--no-picture"});
  EXPECT_EQ(outside.exit_code, 3);
  EXPECT_NE(outside.err.find("are smaller than those of the table, which has 7.9"), std::string::npos) << outside.err;
  EXPECT_TRUE(record()["quantities"].empty());
  EXPECT_FALSE(fs::exists(folder_.path() / "population" / "population.png")) << "of the run before";
}

TEST_F(PopulationCommand, GatesOnTheShapeAreAnErrorOfTheEffectiveModulus) {
  write_file(folder_.path() / "cortex.toml", cells_with_cortex(2, 10));
  synth("control.rtdc", {"recording.cells=300"}, "cortex.toml");
  const auto analysed = [&](const std::vector<std::string>& gates) {
    std::vector<std::string> words{
        "population",           "--model",     "effective", "--section", "tube", "--condition",
        "control=control.rtdc", "--no-picture"};
    words.insert(words.end(), gates.begin(), gates.end());
    const Ended ended = call(words);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto recording = record()["recordings"][0];
    return std::tuple(recording["effective_modulus_ln_median"].get<double>(),
                      recording["effective_modulus_ln_median_common_error"].get<double>(), ended.err);
  };
  const auto [all, error_of_all, silence] = analysed({});
  const auto [stiff, error_of_stiff, words] = analysed({"--max", "deform=0.014"});
  EXPECT_GT(stiff - all, 0.05) << "the selection matters";
  EXPECT_NEAR(error_of_stiff, std::hypot(error_of_all, stiff - all), 0.02);
  EXPECT_NE(words.find("the gates select cells by their shape. Without gates"), std::string::npos) << words;
  EXPECT_EQ(silence.find("select cells"), std::string::npos);
}

TEST_F(PopulationCommand, SolidsHaveNoCortexToTell) {
  synth("solids.rtdc", {"recording.cells=300"});
  const Ended ended =
      call({"population", "--model", "cortex", "--condition", "a=solids.rtdc", "--no-picture", "--min", "area_um=60"});
  EXPECT_NE(ended.err.find("bulk and cortex are not determined separately, because"), std::string::npos) << ended.err;
  const auto all = record();
  EXPECT_FALSE(all["conditions"][0].contains("cortex_modulus_median_mN_per_m"));
  EXPECT_EQ(all["conditions"][0]["stiffness_median_kPa"].is_null(), ended.exit_code != 0);
}

TEST_F(PopulationCommand, WhatCellsWithACortexCannotBeAskedIsASentence) {
  synth("a.rtdc", {"recording.cells=60"});
  const auto refused = [&](std::vector<std::string> more, const std::string& sentence) {
    std::vector<std::string> arguments{"population", "--condition", "a=a.rtdc", "--no-picture"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = call(arguments);
    EXPECT_EQ(ended.exit_code, 2) << sentence;
    EXPECT_NE(ended.err.find(sentence), std::string::npos) << ended.err;
  };
  refused({"--model", "cortex", "--by", "deformation"}, "--by deformation and --model cortex contradict each other");
  refused({"--model", "jelly"}, "--model");
  refused({"--model", "solid", "--section", "tube"}, "--section is for --model cortex");
  refused({"--model", "cortex", "--table", "HE-3D-el-26"},
          "--table HE-3D-el-26: it is not a table of cells with bulk and cortex; the program provides HC-2D-NH-26");
  refused({"--model", "cortex", "--table", "HC-2D-26"},
          "--table HC-2D-26: there is no such file or folder. The program provides HC-2D-NH-26; `rheocyte table` "
          "computes any other table of cells with bulk and cortex in two minutes");
}

}  // namespace
}  // namespace rheocyte::test::population_test
