// Files of polygon filters of dclab and DCscope are the gates that they were there.
#include "events/polygon_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "case/user_error.h"
#include "measurement/recording_writer.h"

namespace rheocyte::polygon_file_test {
namespace {

using test::ScratchFolder;

// As dclab 0.73 saves them, the second one with points out of order, written on Windows.
constexpr const char* two_filters =
    "[Polygon 00000000]\nX Axis = area_um\nY Axis = deform\nName = polygon filter 0\nInverted = False\n"
    "point00000000 = 4.000000000000000e+01 0.000000000000000e+00\n"
    "point00000001 = 9.000000000000000e+01 0.000000000000000e+00\n"
    "point00000002 = 9.000000000000000e+01 1.000000000000000e-01\n"
    "[Polygon 00000001]\r\nX Axis = Area_um\r\nY Axis = deform\r\nName = a = b\r\nInverted = True\r\n"
    "point00000001 = [1 0]\r\npoint00000000 = 0 0\r\npoint00000002 = 1 1\r\n\r\n";

std::vector<PolygonGate> gates_of(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return polygon_gates(file.string());
}

TEST(PolygonFile, HoldsEachOfItsFilters) {
  const ScratchFolder folder;
  const auto gates = gates_of(folder / "two.poly", two_filters);
  ASSERT_EQ(gates.size(), 2U);
  EXPECT_EQ(gates[0].description(), "area_um,deform in a polygon of 3 corners");
  EXPECT_EQ(gates[1].description(), "area_um,deform outside a polygon of 3 corners");
  EXPECT_TRUE(gates[0].holds(80, 0.01) && !gates[0].holds(50, 0.05));
  EXPECT_TRUE(gates[1].holds(0.8, 0.1));
}

TEST(PolygonFile, AnInvertedFilterTakesWhatIsOutsideAndWhatIsNoNumber) {
  const ScratchFolder folder;
  {
    test::RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("area_um", {0.8, 0.2, NAN, 5});
    writer.scalar("deform", {0.1, 0.5, 0.1, 0.1});
  }
  const Recording recording(folder / "a.rtdc");
  ShapeSource shapes(recording, 0.34);
  EventFeatures features(recording, shapes);
  std::vector<char> inside(4, 1);
  gates_of(folder / "two.poly", two_filters)[1].apply(features, 0, inside);
  EXPECT_EQ(inside, (std::vector<char>{0, 1, 1, 1}));
}

void expect_file_refused(const std::filesystem::path& file, const std::string& words) {
  try {
    static_cast<void>(polygon_gates(file.string()));
    FAIL() << file << " was taken";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(PolygonFile, WhatIsNoneIsRefusedWithItsLine) {
  const ScratchFolder folder;
  const auto with = [&](const std::string& text) {
    std::ofstream(folder / "a.poly") << text;
    return folder / "a.poly";
  };
  expect_file_refused(with(""), "contains no polygon filters");
  expect_file_refused(with("area_um,deform=1,2:3,4:5,6\n"), "line 1 is not a line of a polygon filter");
  expect_file_refused(with("[Polygon 0]\nX Axis = a\npoint0 = 1 x\n"), "line 3 is not a line of a polygon filter");
  expect_file_refused(with("[Polygon 0]\nX Axis = a\npoint0 = 1 inf\n"), "line 3 is not a line of a polygon filter");
  expect_file_refused(with("[Polygon 0]\nColour = red\n"), "line 2 is not a line of a polygon filter");
  expect_file_refused(with("[Polygon 0]\nX Axis = a\nY Axis = b\npoint0 = 1 2\n"), "three corners");
  expect_file_refused(folder / "missing.poly", "cannot be read (No such file");
  ASSERT_EQ(::mkfifo((folder / "pipe.poly").c_str(), 0600), 0);
  expect_file_refused(folder / "pipe.poly", "is not a regular file");
}

}  // namespace
}  // namespace rheocyte::polygon_file_test
