// `rheocyte synth` of cells on their way, and `rheocyte time-course` back to their moduli and viscosities.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "../robustness/run_program.h"
#include "../table/invented_dynamic.h"

namespace rheocyte::test::time_course_test {
namespace {

namespace fs = std::filesystem;

/// With shapes of the invented table.
const std::string population = content_of(CELLS_AT_PLACES) + "[shapes]\ntable = \"table\"\n";

class TimeCourseCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    make_table();
    write_file(folder_.path() / "cells.toml", population);
  }

  void make_table(const std::string& spec = dynamic_spec_text) const {
    const DynamicContent content = invented_dynamic(spec);
    fs::create_directories(folder_.path() / "table");
    write_file(folder_.path() / "table" / "spec.toml", to_toml(content.spec));
    write_file(folder_.path() / "table" / dynamic_file_name("invented"), to_bytes(content));
  }

  Ended call(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), RHEOCYTE);
    return run({.arguments = arguments, .folder = folder_.path()});
  }
  Ended synth(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"synth", "cells.toml", "-o", "cells.rtdc", "--quiet", "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return call(arguments);
  }
  Ended time_course(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"time-course", "cells.rtdc", "--table", "table", "-o", "cells.tsv"};
    if (more.empty()) arguments.insert(arguments.end(), {"--contraction-um", "0"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return call(arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(TimeCourseCommand, VirtualCellsSeenAtFourPlacesGiveBackTheirPopulation) {
  ASSERT_EQ(synth().exit_code, 0);
  const Ended ended = time_course();
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(ended.out.starts_with("80 cells, 80 of them seen over at least 20 um; 0 events")) << ended.out;
  const auto at = ended.out.find("population: Young's modulus ");
  ASSERT_NE(at, std::string::npos) << ended.out;
  std::istringstream text(ended.out.substr(at + 28));
  double modulus = 0;
  text >> modulus;
  // The median of the law is 4.95; pixels and 80 cells leave 3 % (one standard deviation of the mean: 1.6 %).
  EXPECT_NEAR(modulus, 4.95, 0.25);
  const std::string table = content_of(folder_.path() / "cells.tsv");
  EXPECT_TRUE(table.starts_with("recording\tcell\tevents\tfirst_place_um\t"));
  EXPECT_NE(table.find("\tresolved\t1 2 3 4\n"), std::string::npos) << table;
}

TEST_F(TimeCourseCommand, VirtualCellsOfTheTableAreKnownAsItsOwnUnlessTheirSectionIsGiven) {
  // The recording says of which cells it was made: the channel is the table's tube.
  ASSERT_EQ(synth().exit_code, 0);
  ASSERT_EQ(time_course().exit_code, 0);
  const std::string known = content_of(folder_.path() / "cells.tsv");
  EXPECT_NE(known.find("made by rheocyte synth from cells of the table"), std::string::npos) << known;
  EXPECT_EQ(known.find("the channel is square"), std::string::npos) << known;
  ASSERT_EQ(time_course({"--contraction-um", "0", "--section", "square"}).exit_code, 0);
  const std::string told = content_of(folder_.path() / "cells.tsv");
  EXPECT_EQ(told.find("made by rheocyte synth"), std::string::npos) << told;
  EXPECT_NE(told.find("the channel is square"), std::string::npos) << told;
}

TEST_F(TimeCourseCommand, ATableOfTheSquareChannelNeedsNothingOfTheTube) {
  // Cells of its own liquid are compared as they are, those of a thinning one by the stationary solids of both.
  make_table(square_dynamic_spec_text);
  ASSERT_EQ(synth().exit_code, 0);
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--contraction-um", "0", "--section", "square"}}) {
    const Ended ended = time_course(more);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(ended.out.starts_with("80 cells, 80 of them seen over at least 20 um; 0 events")) << ended.out;
    EXPECT_EQ(ended.out.find("c3 was divided"), std::string::npos) << ended.out;
  }
  expect_sentence(time_course({"--contraction-um", "0", "--section", "tube"}), "is one of the square channel");
  const Ended thinning =
      time_course({"--contraction-um", "0", "--section", "square", "--medium", "CellCarrier", "--temperature", "23"});
  ASSERT_EQ(thinning.exit_code, 0) << thinning.err;
  EXPECT_NE(thinning.out.find("the liquid is not shear-thinning as that of the table: c3 was divided by"),
            std::string::npos)
      << thinning.out;
}

TEST_F(TimeCourseCommand, ElongatedCellsAreSaidToBeAndRoundOnesAreNot) {
  // An ellipse added to each outline stands for the tension; c2 beyond the table's is a column.
  ASSERT_EQ(synth().exit_code, 0);
  EXPECT_EQ(time_course().out.find("elongated"), std::string::npos);
  ASSERT_EQ(synth({"--set", "cell.added_ellipse=0.1"}).exit_code, 0);
  const Ended ended = time_course();
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("the cells are elongated along the flow (c2 0."), std::string::npos) << ended.out;
  EXPECT_NE(content_of(folder_.path() / "cells.tsv").find("\tmode_2_excess\ttension_factor\tstatus"),
            std::string::npos);
}

TEST_F(TimeCourseCommand, WhatDoesNotTellAViscosityIsRefusedInASentence) {
  ASSERT_EQ(synth({"--set", "recording.cells=20", "--set", "recording.places_um=[60, 65]"}).exit_code, 0);
  expect_sentence(time_course(), "all cells were seen at one place");
  ASSERT_EQ(synth({"--set", "recording.cells=12", "--set", "recording.places_um=[60]"}).exit_code, 0);
  expect_sentence(time_course(), "One picture does not distinguish");
  expect_sentence(time_course({"--contraction-um", "2000"}), "is --contraction-um right?");
  expect_sentence(time_course({"--contraction-um", "0,1,2"}), "--contraction-um has 3 places for 1 recordings");
  expect_sentence(time_course({"--contraction-um", "0", "--channel-width-um", "30"}),
                  "is for the contraction to one of");
}

TEST_F(TimeCourseCommand, CellsOnTheirWayNeedADynamicTableWithPlacesAndViscosity) {
  // Without shapes.table that of the program is taken, which is to be had by its name, too.
  const std::string cells = population.substr(0, population.find("[shapes]"));
  write_file(folder_.path() / "cells.toml", cells);
  EXPECT_EQ(synth({"--set", "recording.cells=5"}).exit_code, 0);
  EXPECT_EQ(synth({"--set", "recording.cells=5", "--set", "shapes.table=HE-chip-26"}).exit_code, 0);
  expect_sentence(synth({"--set", "cell.radius_um.mean=2"}), "None of the 320 pictures of cells can be recorded: 320 ");
  expect_sentence(synth({"--set", "recording.places_um=[320]"}),
                  "80 at a place outside the table; the shapes come from");
  expect_sentence(synth({"--set", "recording.places_um=[320]"}), " to 310 um behind the contraction");
  expect_sentence(synth({"--set", "shapes.model=analytical"}),
                  "recording.places_um and shapes.model = \"analytical\" contradict each other");
  std::string without_places = population;
  without_places.erase(without_places.find("places_um"), std::string("places_um = [15, 60, 140, 290]\n").size());
  write_file(folder_.path() / "cells.toml", without_places);
  expect_sentence(synth(), "has no effect on a stationary shape");
}

}  // namespace
}  // namespace rheocyte::test::time_course_test
