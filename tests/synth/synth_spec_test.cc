// A spec is read completely or refused with a sentence that names file, line, key and what would be right.
#include "synth/synth_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "case/key_reading.h"
#include "case/user_error.h"
#include "synth/synth_keys.h"

namespace rheocyte::synth_spec_test {
namespace {

const std::string channel = "[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\n";
const std::string liquid = "viscosity_mPas = 5.4\n";
const std::string cell = "[cell]\nradius_um = 6\nbulk.young_modulus_kPa = 3\n";

std::string refusal(const std::string& text) {
  try {
    parse_synth_spec(text, "spec.toml");
  } catch (const UserError& error) {
    return error.what();
  }
  return "(accepted)";
}

void expect_refusal(const std::string& text, const std::string& words) {
  const auto sentence = refusal(text);
  EXPECT_NE(sentence.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << sentence;
  EXPECT_EQ(sentence.find('\n'), std::string::npos);
}

TEST(SynthSpec, ShortestOneIsCompletedByDefaults) {
  const auto spec = parse_synth_spec(channel + liquid + cell, "spec.toml");
  EXPECT_EQ(spec.cells, 500);
  EXPECT_EQ(spec.pixel_size_um, 0.34);
  EXPECT_EQ(spec.radius_um.mean, 6);
  EXPECT_EQ(spec.radius_um.deviation, 0);
  EXPECT_EQ(spec.stiffness().mean, 3);
  EXPECT_EQ(spec.viscosity_mPas, 5.4);
  EXPECT_FALSE(spec.analytical) << "the shapes are those of the table by which moduli are read";
  EXPECT_EQ(spec.max_deformation, 0) << "the table has its own end";
  EXPECT_EQ(parse_synth_spec(channel + liquid + cell + "[shapes]\nmodel = \"analytical\"\n", "s").max_deformation, 0.02)
      << "where the analytical model holds";
  EXPECT_EQ(spec.image_size().width, 250U);
  EXPECT_EQ(spec.image_size().height, 78U) << "20 um and 3 um on each side";
}

TEST(SynthSpec, SpreadsHaveMeanDeviationAndLaw) {
  const auto spec =
      parse_synth_spec(channel + "medium = \"CellCarrier\"\ntemperature_C = {mean = 24, sd = 0.5}\n" +
                           "[cell]\nradius_um = {mean = 6, sd = 0.5}\n"
                           "[cell.bulk.young_modulus_kPa]\nmean = 2\nsd = 1\ndistribution = \"lognormal\"\n",
                       "spec.toml");
  EXPECT_EQ(spec.temperature_C.deviation, 0.5);
  EXPECT_EQ(spec.radius_um.at(2), 7);
  EXPECT_EQ(spec.stiffness().law, Spread::Law::lognormal);
  EXPECT_NEAR(spec.stiffness().at(0), 2 / std::sqrt(1.25), 1e-12) << "the median of a lognormal law";
}

TEST(SynthSpec, CombinedCellsHaveASpreadOfEachModulus) {
  const auto spec = parse_synth_spec(channel + liquid + cell +
                                         "kind = \"combined\"\ncortex.modulus_mN_per_m = {mean = 5, sd = 1}\n"
                                         "cortex.tension_ratio = {mean = 0.1, sd = 0.02}\n[shapes]\ntable = \"t\"\n",
                                     "spec.toml");
  EXPECT_EQ(spec.kind, CellKind::combined);
  EXPECT_EQ(spec.stiffness().mean, 3);
  EXPECT_EQ(spec.cortex_modulus_mN_per_m->deviation, 1);
  EXPECT_EQ(spec.tension_ratio.value().deviation, 0.02);
}

TEST(SynthSpec, MistakesAreNamedWithTheWayOut) {
  expect_refusal("", "spec.toml");
  expect_refusal(liquid, "unknown key viscosity_mPas");
  expect_refusal(channel + liquid + "[cell]\nbulk.young_modulus_kPa = 3\n", "cell.radius_um is missing");
  expect_refusal(channel + liquid + "[cell]\nradius_um = 6\n", "cell.bulk.young_modulus_kPa is missing");
  expect_refusal(channel + liquid + cell + "radus_um = 6\n", "did you mean cell.radius_um?");
  expect_refusal(channel + liquid + cell + "[recording]\ncells = 1.5\n", "is not a whole number");
  expect_refusal(channel + liquid + cell + "[recording]\ncells = 0\n", "1 .. 1e7");
  expect_refusal(channel + liquid + cell + "[recording]\ncells = nan\n", "is not finite");
  expect_refusal(channel + liquid + cell + "[recording]\ncells = \"many\"\n", "is not a number");
  expect_refusal(channel + liquid + cell + "[recording]\npictures = \"image\"\n", "did you mean images?");
  expect_refusal(channel + liquid + cell + "[recording]\ndate = \"1.2.2026\"\n", "must have the form YYYY-MM-DD");
  expect_refusal(channel + liquid + cell + "[recording]\npixel_size_um = 0.01\n[noise]\ncontour_um = -1\n",
                 "0 .. 10 um");
  expect_refusal(channel + liquid + cell + "[channel.width_um]\nmean = 3\n", "");
  expect_refusal(channel + cell, "flow.viscosity_mPas (or flow.medium) is missing");
  expect_refusal(channel + "medium = \"soup\"\n" + cell, "\"soup\" has no known viscosity");
  expect_refusal(channel + "medium = \"0.83% MC-PBS\"\nviscosity_model = \"herold-2017\"\n" + cell, "0.83%");
  expect_refusal(channel + liquid + "medium = \"water\"\n" + cell, "exclude each other");
  expect_refusal(channel + liquid + "temperature_C.sd = 1\n" + cell, "has no effect, because flow.viscosity_mPas");
  expect_refusal(channel + liquid + cell + "[shapes]\ntable = \"t\"\nduct = \"square\"\n",
                 "because shapes.model is \"table\"");
  expect_refusal(channel + liquid + cell + "[shapes]\ntable = \"t\"\nmodel = \"analytical\"\n",
                 "because shapes.model is \"analytical\"");
  expect_refusal(channel + liquid + cell + "[shapes]\nmax_deformation = 0.01\n", "or choose \"analytical\"");
  expect_refusal(channel + liquid + "[cell]\nkind = \"shell\"\nradius_um = 6\ncortex.modulus_mN_per_m = 9\n",
                 "needs shapes.table, the folder of a table of shells, or shapes.model");
  expect_refusal(channel + liquid + cell + "cortex.tension_ratio = 0.1\n", "because cell.kind is \"solid\"");
  expect_refusal(channel + liquid + cell + "kind = \"shell\"\n", "because cell.kind is \"shell\"");
  expect_refusal(channel + liquid + "[cell]\nkind = \"shell\"\nradius_um = 6\n",
                 "cell.cortex.modulus_mN_per_m is missing");
  const std::string both = cell + "kind = \"combined\"\ncortex.modulus_mN_per_m = 3\n";
  expect_refusal(channel + liquid + both + "[shapes]\nmodel = \"analytical\"\n",
                 "cell.kind = \"combined\" and shapes.model = \"analytical\" contradict each other");
  expect_refusal(channel + liquid + cell + "kind = \"combined\"\n", "cell.cortex.modulus_mN_per_m is missing");
  expect_refusal(channel + liquid + cell + "cortex.modulus_mN_per_m.mean = 3\n",
                 "because cell.kind is \"solid\"; remove it or choose \"shell\" or \"combined\"");
  expect_refusal(channel + liquid + cell + "cortex.tension_mN_per_m = 3\n", "remove it or choose \"combined\"");
  expect_refusal(channel + liquid + both + "cortex.tension_ratio = 0.1\ncortex.tension_mN_per_m = 3\n",
                 "exclude each other");
  expect_refusal(channel + liquid + both + "[shapes]\ntable = \"t\"\nduct = \"square\"\n",
                 "because shapes.model is \"table\"");
  expect_refusal(channel + liquid +
                     "[cell]\nkind = \"shell\"\nradius_um = 6\ncortex.modulus_mN_per_m = 9\n"
                     "cortex.tension_ratio = {mean = 0.1, sd = 0.1}\n",
                 "one number for all shells");
  expect_refusal(channel + liquid + "[cell]\nradius_um.sd = 6\nbulk.young_modulus_kPa = 3\n",
                 "needs cell.radius_um.mean");
  expect_refusal(
      channel + liquid + "[cell]\nradius_um = {mean = 6, distribution = \"gamma\"}\nbulk.young_modulus_kPa = 3\n",
      "\"normal\" or \"lognormal\"");
}

std::string content_of(const char* name) {
  std::ifstream file(name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(SynthSpec, TheExamplesAreSome) {
  EXPECT_EQ(parse_synth_spec(content_of(SYNTH_EXAMPLE), "example").pictures, Pictures::images);
  EXPECT_EQ(parse_synth_spec(content_of(SYNTH_COMBINED_EXAMPLE), "example").kind, CellKind::combined);
}

TEST(SynthSpec, FormerNamesAreReadAndTheNewOnesTold) {
  const std::string text = channel + liquid + "[cell]\nradius_um = 6\nyoung_modulus_kPa = {mean = 3, sd = 1}\n";
  EXPECT_EQ(parse_synth_spec(text, "spec.toml").young_modulus_kPa->deviation, 1);
  const auto remarks = remarks_on_names(key_list(synth_keys()), given_keys(text, "spec.toml"));
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_EQ(
      remarks[0],
      "spec.toml:8: cell.young_modulus_kPa.mean is now called cell.bulk.young_modulus_kPa.mean; this version still "
      "reads the old name.");
  expect_refusal(text + "[cell.bulk.young_modulus_kPa]\nmean = 3\n", "is given twice");
}

TEST(SynthSpec, ASettingReplacesAKeyOrAPartOfASpread) {
  const std::string text = channel + liquid + "[cell]\nradius_um = {mean = 6, sd = 1}\nbulk.young_modulus_kPa = 3\n";
  const auto read = [&](std::vector<std::string> settings) { return parse_synth_spec(text, "spec.toml", settings); };
  EXPECT_EQ(read({"cell.radius_um.sd=0.5"}).radius_um.mean, 6);
  EXPECT_EQ(read({"cell.radius_um.sd=0.5"}).radius_um.deviation, 0.5);
  EXPECT_EQ(read({"cell.radius_um=7"}).radius_um.deviation, 0) << "all cells alike";
  EXPECT_EQ(read({"flow.medium=water"}).medium, "water") << "a setting wins over the alternative in the file";
}

TEST(SynthSpec, TheReferenceInDocsIsUpToDate) {
  EXPECT_EQ(content_of(SYNTH_REFERENCE), reference_markdown(synth_reference()))
      << "run `build/rheocyte help synth --markdown > docs/synth-reference.md`";
}

}  // namespace
}  // namespace rheocyte::synth_spec_test
