// Columns of populations: names of one grammar, the same of a quantity wherever it stands, and no value where there is
// no number.
#include "report/population_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "experiment/condition_reports.h"
#include "report/population_files.h"

namespace rheocyte::population_columns_test {
namespace {

RecordingReport recording(PopulationQuantity quantity, std::size_t session) {
  RecordingReport r;
  r.recording = "r" + std::to_string(session) + ".rtdc";
  r.session = session;
  r.conditions.flow = {20, 0.04, 15};
  r.median_viscosity_mPas = 15;
  r.fitted_events = 100;
  r.log_radius = std::log(6.5), r.radius_spread = 0.07;
  r.quantities = {{quantity, {std::log(2.0), 1e-4}, 0.2}};
  return r;
}

PopulationReport report_of(const std::string& model, std::vector<RecordingReport> recordings) {
  PopulationReport report;
  report.model = model;
  report.recordings = std::move(recordings);
  report.conditions = condition_reports(report.recordings, {{"a", {}}}, report.level);
  return report;
}

template <class Row>
std::set<std::string> names_of(const Columns<Row>& columns) {
  std::set<std::string> names;
  for (const auto& column : columns) EXPECT_TRUE(names.insert(column.name).second) << column.name << " stands twice";
  return names;
}

void expect_grammar(const std::set<std::string>& names) {
  for (const std::string& name : names) {
    EXPECT_FALSE(name.starts_with("median_") || name.starts_with("mean_")) << name << ": the quantity stands first";
    if (!name.ends_with("_low")) continue;
    EXPECT_TRUE(names.contains(name.substr(0, name.size() - 4) + "_high")) << name;
  }
}

TEST(PopulationColumns, OfAQuantityHaveTheSameNamesForSolidsAndCellsWithACortex) {
  const auto solids = report_of("solid", {recording(PopulationQuantity::young_modulus, 0)});
  const auto cortex = report_of("cortex", {recording(PopulationQuantity::young_modulus, 0)});
  for (const auto& [some, others] :
       {std::pair(names_of(recording_columns(solids)), names_of(recording_columns(cortex))),
        std::pair(names_of(condition_columns(solids)), names_of(condition_columns(cortex)))}) {
    expect_grammar(some);
    std::size_t of_modulus = 0;
    for (const std::string& name : some) {
      if (!name.starts_with("young_modulus_") || name == "young_modulus_ln_single_image_error") continue;
      ++of_modulus;
      EXPECT_TRUE(others.contains(name)) << name;
    }
    EXPECT_GT(of_modulus, 5U);
  }
}

TEST(PopulationColumns, OfTheEffectiveModulusAreThoseOfAnyQuantity) {
  const auto cortex = report_of("cortex", {recording(PopulationQuantity::effective_modulus, 0)});
  for (const auto& names : {names_of(recording_columns(cortex)), names_of(condition_columns(cortex))})
    for (const char* const ending : {"", "_low", "_high"})
      EXPECT_TRUE(names.contains(std::string("effective_modulus_median_kPa") + ending)) << ending;
}

/// Without an interval of its own, that of the normal law.
TEST(PopulationColumns, OfAQuantityHaveItsMedianWithItsInterval) {
  auto own = recording(PopulationQuantity::young_modulus, 1);
  own.quantities.front().log_interval = ParameterInterval{std::log(1.5), std::log(3.0)};
  const auto record =
      population_record(report_of("solid", {recording(PopulationQuantity::young_modulus, 0), own}))["recordings"];
  EXPECT_NEAR(record[0]["young_modulus_median_kPa"], 2, 1e-12);
  EXPECT_NEAR(record[0]["young_modulus_median_kPa_low"], 2 * std::exp(-1.959964e-2), 1e-6);
  EXPECT_NEAR(record[0]["young_modulus_ln_median_error"], 0.01, 1e-12);
  EXPECT_NEAR(record[0]["young_modulus_mean_kPa"], 2 * std::exp(0.02), 1e-12);
  EXPECT_NEAR(record[1]["young_modulus_median_kPa_low"], 1.5, 1e-12);
  EXPECT_NEAR(record[1]["young_modulus_median_kPa_high"], 3, 1e-12);
}

TEST(PopulationColumns, OfARecordingWithoutANumberAreNullAndNan) {
  auto failed = recording(PopulationQuantity::young_modulus, 1);
  failed.failure = "no number";
  const auto report = report_of("solid", {recording(PopulationQuantity::young_modulus, 0), failed});
  const auto rows = population_record(report)["recordings"];
  for (const char* const name :
       {"young_modulus_median_kPa", "young_modulus_ln_spread", "correlation", "kept_fraction"}) {
    EXPECT_FALSE(rows[0][name].is_null()) << name;
    EXPECT_TRUE(rows[1][name].is_null()) << name;
  }
  EXPECT_EQ(rows[1]["failure"], "no number");
  EXPECT_EQ(rows[1]["fits"], false);
  const std::string table = population_table(report);
  EXPECT_NE(table.find("a\t2\tr1.rtdc\t100\tnan\tnan\tnan\t"), std::string::npos) << table;
}

TEST(PopulationColumns, AreThereWhereNoRecordingHasANumber) {
  auto failed = recording(PopulationQuantity::young_modulus, 0);
  failed.failure = "no number";
  failed.quantities.clear();
  EXPECT_TRUE(names_of(recording_columns(report_of("solid", {failed}))).contains("young_modulus_median_kPa"));
  EXPECT_TRUE(names_of(condition_columns(report_of("cortex", {failed}))).contains("stiffness_median_kPa"));
}

/// Files of the version before begin with these words, too: they may be replaced.
TEST(PopulationColumns, OfFilesBeginWithTheirMarks) {
  RecordingReport r = recording(PopulationQuantity::young_modulus, 0);
  r.fitted.shrunken = {{1.8, 0.1, 0.7, 0.2}, {1.9, 0.1, 0.8, 0.2}};
  r.shrunken_events = {7, 3};
  const std::string events = population_events_table(r);
  EXPECT_TRUE(events.starts_with(mark_of_population_events));
  EXPECT_EQ(events,
            "event\tyoung_modulus_kPa\tyoung_modulus_ln_error\tradius_um\tradius_ln_error\n"
            "3\t2.2255\t0.2\t6.6859\t0.1\n7\t2.0138\t0.2\t6.0496\t0.1\n");
  const auto report = report_of("solid", {r});
  EXPECT_TRUE(population_table(report).starts_with(mark_of_population_table));
  EXPECT_TRUE(population_json(report).starts_with(mark_of_population_json));
}

}  // namespace
}  // namespace rheocyte::population_columns_test
