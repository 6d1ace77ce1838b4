// Columns are declared once: each has one name, and what is written are its values.
#include "report/event_columns.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "measurement/recording_writer.h"
#include "report/event_table.h"
#include "report/former_names.h"
#include "report/moduli_columns.h"
#include "report/moduli_summary_columns.h"
#include "report/summary_columns.h"
#include "report/time_course_table.h"

namespace rheocyte::event_columns_test {
namespace {

template <class Columns>
void expect_names_of_their_own(const Columns& columns) {
  std::set<std::string> names;
  for (const auto& column : columns) EXPECT_TRUE(names.insert(column.name).second) << column.name;
}

TEST(EventColumns, HaveNamesOfTheirOwnAndRolesTheirLabels) {
  for (const auto by : {ElongatedBy::modes, ElongatedBy::inertia})
    expect_names_of_their_own(event_columns({true, true, true, by}));
  expect_names_of_their_own(moduli_columns());
  expect_names_of_their_own(summary_columns());
  expect_names_of_their_own(course_columns());
  int rank = 0;
  std::set<std::string> roles;
  for (const ColumnDescription& column : companion_columns()) {
    EXPECT_TRUE(roles.insert(column.role).second) << column.role;
    EXPECT_FALSE(column.label.empty() || column.sentence.empty()) << column.role;
    EXPECT_GE(column.rank, rank) << column.role;
    rank = column.rank;
  }
  for (const auto& feature : moduli_features()) EXPECT_TRUE(roles.insert(feature.role).second) << feature.role;
}

/// Quantity, statistic, unit, and then what else a name may end in.
template <class Columns>
void expect_present_names(const Columns& columns) {
  for (const auto& column : columns) EXPECT_EQ(present_name(column.name), column.name);
}

TEST(Columns, HaveNoFormerNamesAndThoseOfSummariesALabelAndASentence) {
  for (const auto by : {ElongatedBy::modes, ElongatedBy::inertia})
    expect_present_names(event_columns({true, true, true, by}));
  expect_present_names(moduli_columns());
  expect_present_names(summary_columns());
  expect_present_names(moduli_summary_columns());
  expect_present_names(median_cell_columns());
  for (const auto& column : summary_columns())
    EXPECT_TRUE(column.digits == digits_of_counts || !(column.label.empty() || column.sentence.empty())) << column.name;
}

TEST(Columns, OfAPartOfARowAreNamedBehindItsStartAndPrintedNumbersAreThoseOfTexts) {
  ColumnList<double> part;
  part.add_with_errors(
      {"x_kPa", "kPa", "X", "of a test", "", 0, 3}, [](double x) { return x; }, [](double x) { return x / 10; },
      [](double) { return NAN; });
  ColumnList<std::pair<int, double>> list;
  list.add_of(std::move(part).columns(), &std::pair<int, double>::second, "its_");
  const auto columns = std::move(list).columns();
  const std::pair<int, double> row{1, 2.34567};
  ASSERT_EQ(columns.size(), 3U);
  EXPECT_EQ(columns[0].name, "its_x_kPa");
  EXPECT_EQ(columns[1].name, "its_x_kPa_error");
  EXPECT_EQ(columns[2].name, "its_x_kPa_common_error");
  EXPECT_EQ(std::get<double>(printed_value(columns[0], columns[0].value(row))), 2.35);
  EXPECT_FALSE(has_value(columns[2].value(row)));
}

TEST(EventColumns, AreThoseOfWhatIsKnown) {
  const auto names = [](const EventKnowledge& known) {
    std::vector<std::string> names;
    for (const auto& column : event_columns(known)) names.push_back(column.name);
    return names;
  };
  const std::vector<std::string> least{"area_um2", "deformation", "viscosity_mPas", "young_modulus_kPa", "state"};
  EXPECT_EQ(names({}), least);
  EXPECT_EQ(names({.errors = true}).at(4), "young_modulus_kPa_error");
  EXPECT_EQ(names({.shapes = true}).size(), least.size() + 4);
  EXPECT_EQ(names({.elongated_by = ElongatedBy::inertia}).at(5), "young_modulus_inertia_kPa");
}

TEST(EventTable, WritesAllColumnsOfAnEventInALine) {
  const test::ScratchFolder folder;
  const std::vector<double> area{80.5, 90}, deformation{0.02, NAN}, viscosity{5, 5}, modulus{1.25, NAN};
  const std::vector<ModulusState> state{ModulusState::valid, ModulusState::no_data};
  const std::vector<ShapeExcess> shape{{1, 0.06, 0.01, 0.1}, {NAN, NAN, NAN, NAN}};
  EventBlock block;
  block.area_um2 = area;
  block.deformation = deformation;
  block.viscosity_mPas = viscosity;
  block.young_modulus_kPa = modulus;
  block.state = state;
  block.shape = shape;
  BlockValues<EventBlock> values(event_columns({.shapes = true}));
  EventTable table(folder / "a.tsv", {"made for a test"}, descriptions(values.columns()));
  table.append(values.of(block));
  table.remark({"the end"});
  table.close();
  std::ifstream stream(folder / "a.tsv");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  const std::string elongated = shape[0].is_elongated() ? "1" : "0";
  EXPECT_EQ(text,
            "event\tarea_um2\tdeformation\tviscosity_mPas\tyoung_modulus_kPa\tstate\tshape_excess\tshape_excess_error\t"
            "elongated\todd_fraction\n# made for a test\n1\t80.5\t0.02\t5\t1.25\tvalid\t" +
                std::string("0.06\t0.01\t") + elongated +
                "\t0.1\n2\t90\tnan\t5\tnan\tno_data\tnan\tnan\t0\tnan\n# the end\n");
}

TEST(SummaryColumns, HoldWholeNumbersWholeAndLeaveOutWhatIsUnknown) {
  ExtractSummary summary;
  summary.recorded = 1234567;
  summary.modulus_kPa.median = 1.23456789;
  summary.median_standard_error_kPa = NAN;
  summary.table = "HE-3D-26";
  const auto text = [&](std::string_view name) {
    for (const auto& column : summary_columns())
      if (column.name == name) return summary_text(column, summary);
    return std::string("no such column");
  };
  EXPECT_EQ(text("events"), "1234567");
  EXPECT_EQ(text("young_modulus_median_kPa"), "1.23457");
  EXPECT_EQ(text("young_modulus_kPa_error_median"), "");
  EXPECT_EQ(text("table"), "HE-3D-26");
}

}  // namespace
}  // namespace rheocyte::event_columns_test
