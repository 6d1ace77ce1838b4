// A published table is read as it stands, and what is wrong with it is named (damage of the format itself:
// tests/table/table_text_test.cc).
#include <fstream>

#include "case/user_error.h"
#include "infer/published_map.h"
#include "measurement/reference_files.h"

namespace rheocyte::published_table_test {
namespace {

const std::string metadata =
    "# free words\n"
    "# BEGIN METADATA\n"
    "# {\"channel_width\": 20.0, \"channel_width_unit\": \"um\",\n"
    "#  \"flow_rate\": 0.04, \"flow_rate_unit\": \"uL/s\", \"fluid_viscosity\": 15,\n"
    "#  \"fluid_viscosity_unit\": \"mPa s\", \"identifier\": \"XX-1\"}\n"
    "# END METADATA\n"
    "#\n";
const std::string header = "# area_um [um^2]\tdeform\temodulus [kPa]\n";
const std::string rows = "1.0e+01\t0.1\t1.0\n20\t0.1\t2\n10\t0.2\t3\n";

std::filesystem::path written(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / ("rheocyte-table-" + std::to_string(::getpid()) + ".txt");
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::string sentence_for(const std::string& text) {
  const auto file = written(text);
  std::string sentence = "read";
  try {
    read_published_table(file);
  } catch (const UserError& error) {
    sentence = error.what();
  }
  std::filesystem::remove(file);
  return sentence;
}

std::string replaced(std::string text, const std::string& old_words, const std::string& new_words) {
  return text.replace(text.find(old_words), old_words.size(), new_words);
}

TEST(PublishedTable, EveryNumberIsRead) {
  const auto file = written(metadata + header + rows);
  const auto table = read_published_table(file);
  std::filesystem::remove(file);
  EXPECT_EQ(table.identifier, "XX-1");
  EXPECT_EQ(table.flow.width_um, 20);
  EXPECT_EQ(table.flow.rate_ul_s, 0.04);
  EXPECT_EQ(table.flow.viscosity_mPas, 15);
  EXPECT_EQ(table.abscissa, Abscissa::area);
  EXPECT_EQ(table.size, (std::vector<double>{10, 20, 10}));
  EXPECT_EQ(table.deformation, (std::vector<double>{0.1, 0.1, 0.2}));
  EXPECT_EQ(table.modulus_kPa, (std::vector<double>{1, 2, 3}));
}

TEST(PublishedTable, LineEndsOfWindowsAndVolumesAreFine) {
  std::string text;
  for (const char c : metadata + replaced(header, "area_um [um^2]", "volume [um^3]") + rows)
    text += c == '\n' ? "\r\n" : std::string(1, c);
  const auto file = written(text);
  EXPECT_EQ(read_published_table(file).abscissa, Abscissa::volume);
  std::filesystem::remove(file);
}

TEST(PublishedTable, WhatIsWrongIsNamed) {
  const auto expect = [](const std::string& text, const std::string& words) {
    const auto sentence = sentence_for(text);
    EXPECT_NE(sentence.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << sentence;
  };
  expect(replaced(metadata, "identifier", "lut identifier") + header + rows, "need a text \"identifier\"");
  expect(metadata + header + rows + "1\t2\n", ":12: does not hold three numbers");
  expect(metadata + header + "1\t2\t3\n", "fewer than three rows");
  expect(metadata + header + "1\t0\t3\n2\t0\t3\n2\t-1\t3\n", "positive deformation");
  EXPECT_THROW(read_published_table("/nowhere/table.txt"), UserError);
}

TEST(PublishedTable, ThePublishedOnesHaveTheirNumbersOfRows) {
  RHEOCYTE_NEED_REFERENCE("lut_LE-2D-FEM-19.txt");
  const auto linear = read_published_table(test::reference_folder() / "lut_LE-2D-FEM-19.txt");
  EXPECT_EQ(linear.size.size(), 13038U);
  EXPECT_EQ(linear.flow.viscosity_mPas, 15);
  const auto hyperelastic = read_published_table(test::reference_folder() / "lut_HE-2D-FEM-22.txt");
  EXPECT_EQ(hyperelastic.size.size(), 16394U);
  EXPECT_EQ(hyperelastic.flow.viscosity_mPas, 6);
  EXPECT_EQ(hyperelastic.identifier, "HE-2D-FEM-22");
}

}  // namespace
}  // namespace rheocyte::published_table_test
