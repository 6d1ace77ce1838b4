// The text of a table can be read back by the rules of dclab's format; damaged texts are named with their line.
#include "table/table_text.h"

#include <gtest/gtest.h>

#include "../refusal.h"
#include "case/user_error.h"

namespace rheocyte::table_text_test {
namespace {

TableText small_table() {
  TableText table;
  table.comments = {"rheocyte 0: invented", ""};
  table.metadata = {{"channel_width", 20.0},    {"channel_width_unit", "um"}, {"flow_rate", 0.04},
                    {"flow_rate_unit", "uL/s"}, {"fluid_viscosity", 15.0},    {"fluid_viscosity_unit", "mPa s"},
                    {"identifier", "XX-2D-26"}, {"case", {{"a", {{"b", 1}}}}}};
  table.rows = {{28.1747, 0.07634, 0.377}, {1.0 / 3, 1e-5 / 7, 1e6 / 3}};
  return table;
}

std::string refusal(const std::string& text) {
  return test::refusal_of([&] { parse_table_text(text, "lut.txt"); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(TableText, ReadsBackWhatWasWritten) {
  for (const auto abscissa : {Abscissa::area, Abscissa::volume}) {
    auto table = small_table();
    table.abscissa = abscissa;
    const auto text = to_text(table);
    const auto back = parse_table_text(text, "x");
    EXPECT_EQ(back.metadata, table.metadata);
    EXPECT_EQ(back.comments, table.comments);
    EXPECT_EQ(back.abscissa, abscissa);
    ASSERT_EQ(back.rows.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 3; ++k)  // ten digits
        EXPECT_NEAR(back.rows[i][k] / table.rows[i][k], 1, 1e-9);
    EXPECT_EQ(to_text(back), text);
  }
}

TEST(TableText, HasTheLinesThatDclabWants) {
  const auto text = to_text(small_table());
  EXPECT_NE(text.find("\n# BEGIN METADATA\n# {\n"), std::string::npos);
  EXPECT_NE(text.find("\n# }\n# END METADATA\n#\n# area_um [um^2]\tdeform\temodulus [kPa]\n2.817470000e+01\t7.6340"),
            std::string::npos);
  for (const char c : text) EXPECT_TRUE(c == '\n' || c == '\t' || (c >= ' ' && c <= '~'));
}

TEST(TableText, WindowsLineEndsAndEmptyLinesAreAccepted) {
  std::string text;
  for (const char c : to_text(small_table())) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto back = parse_table_text(text + "\r\n", "x");
  EXPECT_EQ(to_text(back), to_text(small_table()));
}

TEST(TableText, SignsAndSpacesBetweenTheNumbersAreAccepted) {
  const auto back = parse_table_text(replaced(to_text(small_table()), "\t7.634", " \t +7.634"), "x");
  EXPECT_EQ(to_text(back), to_text(small_table()));
}

TEST(TableText, DamageIsNamedWithItsLine) {
  const auto good = to_text(small_table());
  const auto expect = [](const std::string& text, const std::string& words) {
    EXPECT_NE(refusal(text).find(words), std::string::npos) << "wanted: " << words << "\n   got: " << refusal(text);
  };
  expect("", "lut.txt: contains no rows");
  expect(good.substr(0, good.find("2.817")), "contains no rows");
  expect(replaced(good, "# BEGIN METADATA", "# BEGIN"), "not valid JSON");
  expect(replaced(good, "# END METADATA", "# END"), "before \"# END METADATA\"");
  expect(replaced(good, "\"um\"", "\"mm\""), "\"channel_width_unit\": \"um\"");
  expect(replaced(good, "15.0", "-15.0"), "no positive number \"fluid_viscosity\"");
  expect(replaced(good, "\"identifier\"", "\"name\""), "no \"identifier\"");
  expect(replaced(good, "area_um [um^2]\tdeform", "deform\tarea_um [um^2]"), "must name the columns");
  expect(replaced(good, "7.634000000e-02", "seven"), "lut.txt:21: does not hold three numbers");
  expect(replaced(good, "7.634000000e-02", "nan"), "does not hold three numbers");
  expect(replaced(good, "2.817470000e+01", "-2.8"), "lut.txt:21: sizes and moduli must be positive");
  expect(replaced(good, "2.817470000e+01", "0"), "lut.txt:21: sizes and moduli must be positive");
  expect(replaced(good, "3.770000000e-01", "0"), "lut.txt:21: sizes and moduli must be positive");
  expect(replaced(good, "3.770000000e-01", "3.77e-01\t1"), "more than three numbers");
}

}  // namespace
}  // namespace rheocyte::table_text_test
