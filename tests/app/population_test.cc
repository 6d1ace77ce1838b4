// `rheocyte population` from virtual recordings to the answers.
#include <algorithm>

#include "measurement/metadata.h"
#include "measurement/recording.h"
#include "population_fixture.h"

namespace rheocyte::test::population_test {
namespace {

TEST_F(PopulationCommand, ElongatedVirtualCellsGiveBackTheirPopulationAndTheDifference) {
  for (const std::string seed : {"1", "2"}) {
    synth("control" + seed + ".rtdc", {"recording.seed=" + seed});
    synth("drug" + seed + ".rtdc", {"recording.seed=1" + seed}, "drug.toml");
  }
  const Ended ended = call({"population", "--condition", "control=control1.rtdc,control2.rtdc", "--condition",
                            "drug=drug1.rtdc,drug2.rtdc", "--paired"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_LE(std::ranges::count(ended.out, '\n'), 8) << ended.out;
  const std::string told = "drug / control: ratio ";
  const auto at = ended.out.find(told);
  ASSERT_NE(at, std::string::npos) << ended.out;
  EXPECT_NEAR(std::stod(ended.out.substr(at + told.size())), 1.3, 0.04) << "two standard errors";
  EXPECT_NE(ended.out.find("by the paired t test with 1 degrees of freedom"), std::string::npos) << ended.out;
  const auto all = record();
  for (const auto& recording : all["recordings"]) {
    const bool is_drug = recording["condition"] == "drug";
    const double truth = log_median(is_drug ? 5.2 : 4);
    const auto& parameters = recording["parameters"];
    // Four standard errors, and 1 % that the law of the pixels leaves.
    EXPECT_NEAR(parameters[1]["value"], truth, 4 * double(parameters[1]["value_error"]) + 0.01)
        << recording["recording"];
    EXPECT_LT(parameters[1]["value_error"], 0.02);
    EXPECT_NEAR(recording["young_modulus_ln_spread"], spread, 0.04);
    EXPECT_NEAR(recording["radius_median_um"], 6.3, 0.1);
    EXPECT_GT(recording["elongation_median"], 0.05);
    for (const auto& check : recording["checks"]) EXPECT_TRUE(check["fits"]) << check.dump();
  }
  for (const char* const picture : {"population", "population-checks"}) {
    EXPECT_TRUE(fs::exists(folder_.path() / "population" / (std::string(picture) + ".png"))) << ended.err;
    EXPECT_TRUE(fs::exists(folder_.path() / "population" / (std::string(picture) + ".svg")));
  }
  const std::string events = content_of(folder_.path() / "population" / "events_drug_2.tsv");
  EXPECT_NE(events.find("\n250\t"), std::string::npos);
  // Virtual cells under tensions use userdef0 to userdef6 for what is true of them: three are left for four values.
  EXPECT_NE(ended.err.find("its companion lacks: sd of ln radius."), std::string::npos) << ended.err;
  const Recording companion(folder_.path() / "population" / "events_drug_2.rtdc");
  EXPECT_EQ(companion.metadata().text("user:rheocyte shrunken modulus"), "userdef7");
  std::vector<double> moduli(companion.events());
  companion.read_scalar("userdef7", 0, moduli);
  EXPECT_NE(events.find(fmt::format("\n250\t{:.5g}\t", moduli[249])), std::string::npos) << moduli[249];
  EXPECT_TRUE(
      content_of(folder_.path() / "population" / "population.tsv").starts_with("condition\tsession\trecording\t"));
}

TEST_F(PopulationCommand, TheSameInputGivesTheSameBytesForAnyNumberOfThreads) {
  synth("a.rtdc", {"recording.cells=80"});
  for (const std::string jobs : {"1", "3"})
    ASSERT_EQ(call({"population", "--condition", "a=a.rtdc", "-o", "jobs" + jobs, "--jobs", jobs, "--quiet"}).exit_code,
              0);
  EXPECT_EQ(content_of(folder_.path() / "jobs1" / "population.json"),
            content_of(folder_.path() / "jobs3" / "population.json"));
}

/// Single images have the modulus of the cell and the noise of the image.
TEST_F(PopulationCommand, ModuliOfSingleImagesScatterByCellsAndNoiseTogether) {
  synth("a.rtdc", {"recording.cells=400"});
  ASSERT_EQ(call({"population", "--condition", "a=a.rtdc", "--quiet", "--no-picture"}).exit_code, 0);
  const auto recording = record()["recordings"][0];
  const auto& images = recording["moduli_of_single_images"];
  double count = images["without"], sum = 0, squares = 0, at = images["ln_modulus_from"];
  for (const double each : images["counts"]) {
    const double middle = at + 0.5 * double(images["step"]);
    count += each, sum += each * middle, squares += each * middle * middle;
    at += double(images["step"]);
  }
  EXPECT_EQ(count, recording["events"]);
  const double inside = count - double(images["without"]), mean = sum / inside;
  const double expected = std::hypot(double(recording["young_modulus_ln_spread"]),
                                     double(recording["young_modulus_ln_single_image_error"]));
  EXPECT_NEAR(std::sqrt(squares / inside - mean * mean), expected, 0.15 * expected) << "four standard errors";
  EXPECT_FALSE(fs::exists(folder_.path() / "population" / "population.png"));
}

TEST_F(PopulationCommand, RecordingsOfAConditionMayShareTheirSpread) {
  synth("a.rtdc", {"recording.cells=80"});
  synth("b.rtdc", {"recording.cells=80", "recording.seed=5"});
  const auto spreads = [&](const std::string& folder, const std::vector<std::string>& more) {
    const auto recordings = fitted_recordings("x=a.rtdc,b.rtdc", folder, more);
    return std::pair<double, double>{recordings[0]["young_modulus_ln_spread"],
                                     recordings[1]["young_modulus_ln_spread"]};
  };
  const auto own = spreads("own", {}), shared = spreads("shared", {"--shared-spread"});
  EXPECT_NE(own.first, own.second);
  EXPECT_EQ(shared.first, shared.second);
  EXPECT_GT(shared.first, std::min(own.first, own.second));
  EXPECT_LT(shared.first, std::max(own.first, own.second));
  expect_sentence(call({"population", "--condition", "x=a.rtdc,b.rtdc", "--model", "cortex", "--shared-spread"}),
                  "--shared-spread is for solids");
}

/// So many that they would show a tenth of what the errors of the outline add to d.
TEST_F(PopulationCommand, ErrorsOfTheOutlineAreInTheChecks) {
  synth("a.rtdc", {"recording.cells=2000", "noise.contour_um=0.1", "cell.bulk.young_modulus_kPa.mean=2.5"});
  for (const auto& check : fitted_recordings("a=a.rtdc", "a", {"--outline-noise-um", "0.1"})[0]["checks"])
    EXPECT_TRUE(check["fits"]) << check.dump();
}

TEST_F(PopulationCommand, ErrorsOfTheOutlineArePartOfTheModel) {
  synth("a.rtdc", {"recording.cells=500", "noise.contour_um=0.1"});
  const auto of = [&](const std::string& folder, const std::vector<std::string>& options) {
    return fitted_recordings("a=a.rtdc", folder, options)[0];
  };
  const auto known = of("known", {"--outline-noise-um", "0.1"}), unknown = of("unknown", {});
  EXPECT_EQ(record("known")["outline_noise_um"], 0.1);
  EXPECT_EQ(of("none", {"--outline-noise-um", "0"}), unknown);
  EXPECT_NE(known["settings_hash"], unknown["settings_hash"]);
  EXPECT_EQ(of("jobs", {"--outline-noise-um", "0.1", "--jobs", "3"}), known);
  const auto& parameters = known["parameters"];
  // Four standard errors, and 1 % that the laws leave.
  EXPECT_NEAR(parameters[1]["value"], log_median(4), 4 * double(parameters[1]["value_error"]) + 0.01);
  EXPECT_NEAR(parameters[0]["value"], std::log(6.3), 4 * double(parameters[0]["value_error"]) + 0.005);
  EXPECT_NEAR(known["young_modulus_ln_spread"], spread, 0.04);
  EXPECT_GT(unknown["young_modulus_ln_spread"], known["young_modulus_ln_spread"]);
  for (const auto& check : known["checks"]) EXPECT_TRUE(check["fits"]) << check.dump();
  EXPECT_FALSE(unknown["checks"][1]["fits"]) << "d, which the errors of the outline increase";
  const auto refused = [&](std::vector<std::string> options, const std::string& words) {
    options.insert(options.begin(), {"population", "--condition", "a=a.rtdc"});
    expect_sentence(call(options), words);
  };
  refused({"--outline-noise-um", "-0.1"}, "--outline-noise-um");
  refused({"--outline-noise-um", "nan"}, "--outline-noise-um");
  refused({"--outline-noise-um", "wide"}, "--outline-noise-um");
  refused({"--outline-noise-um", "0.8"}, "is more than a tenth of it");
  refused({"--outline-noise-um", "0.4"},
          "--outline-noise-um 0.4 is too large: it would make the mode c7 of equal cells");
  refused({"--outline-noise-um", "0.1", "--by", "deformation"}, "--outline-noise-um and --by deformation contradict");
}

TEST_F(PopulationCommand, ASpecificationGivesWhatItsOptionsGive) {
  synth("a.rtdc", {"recording.cells=80"});
  synth("b.rtdc", {"recording.cells=80", "recording.seed=5"});
  fs::create_directory(folder_.path() / "specs");
  // "z" comes first, as in the file: conditions are compared with it.
  write_file(folder_.path() / "specs" / "spec.toml",
             "between_recordings = 0.03\noutline_noise_um = 0.05\npaired = true\nmax = {area_um = "
             "500}\n[conditions]\nz = [\"../a.rtdc\"]\n"
             "a = [\"../b.rtdc\"]\n");
  ASSERT_EQ(call({"population", "specs/spec.toml", "-o", "spec", "--quiet", "--no-picture"}).exit_code, 0);
  ASSERT_EQ(call({"population", "--condition", "z=a.rtdc", "--condition", "a=b.rtdc", "--between-recordings", "0.03",
                  "--outline-noise-um", "0.05", "--paired", "--max", "area_um=500", "-o", "options", "--quiet",
                  "--no-picture"})
                .exit_code,
            0);
  auto spec = record("spec"), options = record("options");
  for (auto& recording : spec["recordings"]) {
    const std::string file = recording["recording"];
    EXPECT_TRUE(file.starts_with("specs/../")) << file;
    recording["recording"] = file.substr(std::string("specs/../").size());
  }
  EXPECT_EQ(spec, options);
  // The command line has the last word.
  ASSERT_EQ(
      call({"population", "specs/spec.toml", "-o", "other", "--between-recordings", "0.06", "--quiet", "--no-picture"})
          .exit_code,
      0);
  EXPECT_EQ(record("other")["between_recordings"], 0.06);
  const auto refused = [&](const std::string& text, const std::string& words) {
    write_file(folder_.path() / "wrong.toml", text);
    expect_sentence(call({"population", "wrong.toml"}), words);
  };
  refused("pared = true\n[conditions]\na = [\"a.rtdc\"]\n", "There is no setting pared, did you mean paired?");
  refused("colour = 3\n[conditions]\na = [\"a.rtdc\"]\n", "There is no setting colour");
  refused("paired = 3\n[conditions]\na = [\"a.rtdc\"]\n", "paired must be true or false");
  refused("conditions = 3\n", "conditions must be a section");
  refused("[conditions]\na = [3]\n", "the condition a must be a list of recordings");
  refused("by = \"asymmetry\"\n", "no condition is given");
  refused("a = \n", "not valid TOML");
  refused("\n", "the specification is empty; `rheocyte help population` lists its keys");
  expect_sentence(call({"population", "missing.toml"}), "there is no such specification");
  fs::copy_file(folder_.path() / "a.rtdc", folder_.path() / "5 \u00B5M.rtdc");
  write_file(folder_.path() / "names.toml", "[conditions]\n\"5 \u00B5M\" = ['5 \u00B5M.rtdc']\n");
  ASSERT_EQ(call({"population", "names.toml", "-o", "names", "--quiet", "--no-picture"}).exit_code, 0);
  EXPECT_EQ(record("names")["conditions"][0]["condition"], "5 \u00B5M");
  EXPECT_TRUE(fs::exists(folder_.path() / "names" / "events_5 \u00B5M_1.tsv"));
  expect_sentence(call({"population", "specs/spec.toml", "--condition", "a=a.rtdc"}), "contradict each other");
}

/// Cells under more load that are as much stiffer as its root: their modulus goes as the power 1/2 of the stress.
TEST_F(PopulationCommand, RecordingsAtThreeFlowRatesTellHowTheModulusGrowsWithTheStress) {
  std::string all;
  for (const int rate : {4, 6, 9})
    for (const int seed : {1, 2}) {
      const std::string file = fmt::format("a{}{}.rtdc", rate, seed);
      synth(file, {fmt::format("recording.seed={}{}", rate, seed), fmt::format("flow.rate_ul_per_s=0.0{}", rate),
                   fmt::format("cell.bulk.young_modulus_kPa.mean={}", 4 * std::sqrt(rate / 4.0))});
      all += (all.empty() ? "" : ",") + file;
    }
  const Ended ended = call({"population", "--condition", "a=" + all, "--no-picture"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("a: E grows as the power 0."), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("the recordings of a differ in flow rate (0.04 ul/s and 0.06 ul/s and 0.09 ul/s)"),
            std::string::npos)
      << ended.err;
  const auto found = record()["conditions"][0];
  const double exponent = found["young_modulus_stress_exponent"];
  EXPECT_NEAR(exponent, 0.5, 0.1) << "four standard errors, and 1 % of each modulus that the laws of pixels leave";
  EXPECT_LT(found["young_modulus_stress_exponent_low"], exponent);
  EXPECT_GT(found["young_modulus_stress_exponent_high"], exponent);
}

TEST_F(PopulationCommand, ATableOfElongatedCellsCanBeGiven) {
  synth("a.rtdc", {"recording.cells=80"});
  const auto of = [&](const std::string& folder, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"population", "--condition", "a=a.rtdc",    "-o",
                                       folder,       "--quiet",     "--no-picture"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(call(arguments).exit_code, 0);
    return record(folder)["recordings"][0];
  };
  EXPECT_EQ(of("own", {}), of("named", {"--table", "HE-3D-el-26"}));
  expect_sentence(call({"population", "--condition", "a=a.rtdc", "--table", "LE-2D-26"}),
                  "there is no such table of elongated cells");
}

TEST_F(PopulationCommand, OneRecordingEachHasARatioButNoP) {
  synth("a.rtdc", {"recording.cells=80"});
  synth("b.rtdc", {"recording.cells=80", "recording.seed=5"});
  const Ended ended =
      call({"population", "--condition", "a=a.rtdc", "--condition", "b=b.rtdc", "--between-recordings", "0.03"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("no p, because a single recording gives no scatter between recordings"), std::string::npos);
  EXPECT_NE(ended.out.find("with a scatter of 0.03 between recordings"), std::string::npos);
  EXPECT_TRUE(record()["comparisons"][0]["p"].is_null());
  EXPECT_FALSE(record()["comparisons"][0]["p_by_known_scatter"].is_null());
}

TEST_F(PopulationCommand, TwoRecordingsHaveTheirMeanElongationAndOldFilesGo) {
  synth("a.rtdc", {"recording.cells=80"});
  synth("b.rtdc", {"recording.cells=80", "recording.seed=5", "flow.axial_tension_Pa.mean=20"});
  ASSERT_EQ(call({"population", "--condition", "b=b.rtdc", "--no-picture", "--quiet"}).exit_code, 0);
  for (const char* const file : {"events_b_1.tsv", "events_b_1.rtdc"})
    EXPECT_TRUE(fs::exists(folder_.path() / "population" / file)) << file;
  const Ended ended = call({"population", "--condition", "a=a.rtdc,b.rtdc", "--no-picture"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* const file : {"events_b_1.tsv", "events_b_1.rtdc"})
    EXPECT_FALSE(fs::exists(folder_.path() / "population" / file)) << file;
  const auto recordings = record()["recordings"];
  const double mean = (double(recordings[0]["elongation_median"]) + double(recordings[1]["elongation_median"])) / 2;
  EXPECT_GT(std::abs(double(recordings[0]["elongation_median"]) - mean), 0.01);
  EXPECT_NE(ended.out.find(fmt::format("; c2 {:.3f}; recordings: 2", mean)), std::string::npos) << ended.out;
}

TEST_F(PopulationCommand, GatesOnTheAreaAreCorrectedForAndOthersAreNamed) {
  synth("a.rtdc", {"recording.cells=500"});
  // The median cell has an area of about 130 um2: the gate takes the smaller half.
  const Ended ended = call({"population", "--condition", "a=a.rtdc", "--min", "area_um=130", "--max", "pos_x=1e9"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("the gates on pos_x <= 1000000000 are not part of the model"), std::string::npos)
      << ended.err;
  const auto recording = record()["recordings"][0];
  const auto& parameters = recording["parameters"];
  EXPECT_LT(recording["kept_fraction"], 0.8);
  EXPECT_NEAR(parameters[1]["value"], log_median(4), 4 * double(parameters[1]["value_error"]) + 0.01);
  EXPECT_NEAR(parameters[0]["value"], std::log(6.3), 4 * double(parameters[0]["value_error"]) + 0.005);
}

TEST_F(PopulationCommand, CellsThatAreTooStiffHaveALimitAndExitCode3) {
  write_file(folder_.path() / "stiff.toml", cells(150, 2000));
  synth("a.rtdc", {"recording.cells=100"}, "stiff.toml");
  const Ended ended = call({"population", "--condition", "a=a.rtdc"});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.err.find("too stiff to be seen"), std::string::npos) << ended.err;
  EXPECT_TRUE(record()["recordings"][0]["young_modulus_median_kPa"].is_null());
}

TEST_F(PopulationCommand, WhatDoesNotWorkIsSaidInOneSentence) {
  synth("a.rtdc", {"recording.cells=60"});
  synth("few.rtdc", {"recording.cells=12", "recording.seed=3"});
  fs::copy_file(folder_.path() / "a.rtdc", folder_.path() / "again.rtdc");
  const auto refused = [&](std::vector<std::string> arguments, const std::string& words) {
    arguments.insert(arguments.begin(), "population");
    expect_sentence(call(arguments), words);
  };
  refused({"--condition", "a"}, "give a name and its recordings");
  refused({"--condition", "a=a.rtdc,a.rtdc"}, "is named twice");
  refused({"--condition", "a=a.rtdc", "--condition", "b=again.rtdc"}, "contains the same events as a.rtdc");
  refused({"--condition", "a=a.rtdc", "--condition", "a=few.rtdc"}, "the condition a is given twice");
  refused({"--condition", "a=a.rtdc", "--condition", "b=few.rtdc,again.rtdc", "--paired"},
          "--paired needs equally many");
  refused({"--condition", "../a=a.rtdc"}, "neither slashes nor line breaks");
  refused({"--condition", "a\tb=a.rtdc"}, "neither slashes nor line breaks");
  refused({"--condition", std::string(101, 'a') + "=a.rtdc"}, "no more than 100 characters");
  refused({"--condition", "a=a.rtdc", "-o", "a.rtdc"}, "the folder cannot be made");
  refused({"--condition", "a=few.rtdc"}, "a population needs at least 20");
  refused({"--condition", "a=missing.rtdc"}, "there is no such file");
  refused({"--condition", "a=a.rtdc", "--min", "area_um=900"}, "has no event inside the gates");
  refused({"--condition", "a=a.rtdc", "--by", "colour"}, "must be asymmetry, odd-deformation or deformation");
  EXPECT_FALSE(fs::exists(folder_.path() / "population"));
}

}  // namespace
}  // namespace rheocyte::test::population_test
