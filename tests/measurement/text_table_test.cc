// Tables of events as text: whatever program wrote them, their numbers come out exactly; what is wrong is named by line
// and column.
#include "measurement/text_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "case/user_error.h"

namespace rheocyte::text_table_test {
namespace {

TextTable table_of(const std::string& text) { return parse_text_table(text, "cells.csv"); }

std::vector<double> column(const TextTable& table, const std::string& feature) {
  for (const auto& each : table.columns)
    if (each.feature == feature) return each.values;
  ADD_FAILURE() << feature;
  return {};
}

std::string refusal_of(const std::string& text) {
  try {
    table_of(text);
  } catch (const UserError& error) {
    return error.what();
  }
  return "read";
}

TEST(TextTable, TheSameEventsAreReadWithEachSeparatorLineEndAndQuote) {
  for (const std::string text : {"area_um,deform\n50.25,0.01\n60,2e-2\n", "area_um;deform\n50.25;0.01\n60;2e-2",
                                 "area_um\tdeform\r\n50.25\t0.01\r\n60\t2e-2\r\n",
                                 "\xEF\xBB\xBF\"area_um\",\"deform\"\n 50.25 , \"0.01\"\n\n60,2E-2\n",
                                 "# a comment\n\narea_um, deform\n50.25,0.01\n# another\n60,0.020\n",
                                 "\"Area; raw\"\tarea_um\tdeform\n1\t50.25\t0.01\n2\t60\t.02\n"}) {
    const TextTable table = table_of(text);
    EXPECT_EQ(column(table, "area_um"), (std::vector<double>{50.25, 60})) << text;
    EXPECT_EQ(column(table, "deform"), (std::vector<double>{0.01, 0.02})) << text;
  }
}

TEST(TextTable, ANumberComesBackToTheLastDigit) {
  const TextTable table =
      table_of("deform\n0.1\n0.30000000000000004\n4.9406564584124654e-324\n-1.7976931348623157e308\n");
  EXPECT_EQ(column(table, "deform"), (std::vector<double>{0.1, 0.1 + 0.2, std::numeric_limits<double>::denorm_min(),
                                                          std::numeric_limits<double>::lowest()}));
}

TEST(TextTable, EmptyCellsAndWordsForThemAreNoValues) {
  const TextTable table = table_of("area_um,deform\n,1\nnan,\nNaN,NA\nNone,null\n<NA>,2\n");
  for (const double value : column(table, "area_um")) EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(column(table, "deform").back(), 2);
}

// As dclab 0.73 exports them.
TEST(TextTable, NamesAndMetadataMayBeInCommentsAsDclabWritesThem) {
  const TextTable table = table_of(
      "\xEF\xBB\xBF# dclab version: 0.73.0\n#\n# Original dataset configuration:\n# dc:experiment:sample = a = b\n"
      "# dc:setup:channel width = 20.0\n#\n# area_um\tdeform\n# Area [\xC2\xB5m\xC2\xB2]\tDeformation\n"
      "5.0250000000e+01\t1.0000000000e-02\n");
  EXPECT_EQ(column(table, "area_um"), std::vector<double>{50.25});
  EXPECT_EQ(table.metadata, (MetadataTexts{{"experiment:sample", "a = b"}, {"setup:channel width", "20.0"}}));
}

TEST(TextTable, CommentsWithSectionAndKeyAreMetadata) {
  const TextTable table =
      table_of("# setup:flow rate = 0.04\n#setup:medium=\"CellCarrier B\"\n# at 12:30 x = 1\narea_um\n1\n");
  EXPECT_EQ(table.metadata, (MetadataTexts{{"setup:flow rate", "0.04"}, {"setup:medium", "CellCarrier B"}}));
  EXPECT_EQ(refusal_of("# setup:flow rate = 0.04\n# setup:flow rate = 0.06\narea_um\n1\n"),
            "cells.csv: line 2: setup:flow rate is \"0.06\", but elsewhere \"0.04\"; keep one of them.");
}

TEST(TextTable, ColumnsOfWordsAndOtherNamesAreLeftOut) {
  const TextTable table = table_of(",Area (um2),area_um,drug\n0,5,50,LatB\n1,x,60,none\n");
  ASSERT_EQ(table.columns.size(), 1U);
  EXPECT_EQ(table.left_out, (std::vector<std::string>{"Area (um2) (no name of a feature)",
                                                      "drug (\"LatB\" in line 2 is not a number)"}));
}

TEST(TextTable, WhatIsWrongIsNamedByLineAndColumn) {
  const std::string header = "area_um,deform\n50,0.01\n";
  EXPECT_EQ(refusal_of(""), "cells.csv: is empty; its first line must name columns, such as area_um,deform.");
  EXPECT_EQ(refusal_of("# only a comment\n\n"), refusal_of(""));
  EXPECT_EQ(refusal_of(header + "60,x\n"),
            "cells.csv: line 3, column deform: \"x\" is not a number; correct it, leave the cell empty or remove the "
            "column.");
  EXPECT_EQ(refusal_of("area_um;deform\n50,5;0,01\n"),
            "cells.csv: line 2, column area_um: \"50,5\" has a decimal comma; export the table with decimal points.");
  EXPECT_EQ(refusal_of(header + "60,0.02,3\n"),
            "cells.csv: line 3 has 3 cells, but there are 2 names of columns; export the table again.");
  EXPECT_EQ(refusal_of(header + "60\n"),
            "cells.csv: line 3 has 1 cell, but there are 2 names of columns; export the table again.");
  EXPECT_EQ(refusal_of("area_um,deform\n1,50,0.01\n"),
            "cells.csv: line 2 has 3 cells, but there are 2 names of columns; give each column a name (in R: row.names "
            "= FALSE).");
  EXPECT_EQ(refusal_of("area_um,deform\n50,5,0,01\n"),
            "cells.csv: line 2 has 4 cells, but there are 2 names of columns; export numbers with decimal points, not "
            "commas.");
  EXPECT_EQ(refusal_of("area_um,deform,area_um\n1,2,3\n"),
            "cells.csv: line 1 names the column area_um twice; give each column its own name.");
  EXPECT_EQ(refusal_of("area_um deform\n1 2\n"),
            "cells.csv: line 1 has no comma, semicolon or tab between the names of columns; separate columns by one of "
            "these.");
  EXPECT_EQ(refusal_of("50,0.01\n60,0.02\n"),
            "cells.csv: line 1 contains numbers, but no line before names their columns; put one before it, such as "
            "area_um,deform.");
}

}  // namespace
}  // namespace rheocyte::text_table_test
