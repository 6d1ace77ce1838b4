// A polygon gate holds the places that wind round, and its text says what it is.
#include "events/polygon_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "case/user_error.h"

namespace rheocyte::polygon_gate_test {
namespace {

TEST(PolygonGate, HoldsThePlacesAroundWhichItsCornersWind) {
  std::vector<std::pair<double, double>> star;
  std::string text;
  for (int k = 0; k < 14; ++k) {
    const double radius = k % 2 ? 0.2 : 0.5, angle = M_PI * k / 7;
    star.emplace_back(0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle));
    text += (k ? ":" : "a,b=") + std::to_string(star.back().first) + "," + std::to_string(star.back().second);
  }
  const PolygonGate gate(text);
  const auto winds = [&](double x, double y) {
    double turn = 0;
    for (std::size_t k = 0; k < star.size(); ++k) {
      const auto [ax, ay] = star[k];
      const auto [bx, by] = star[(k + 1) % star.size()];
      turn += std::atan2((ax - x) * (by - y) - (ay - y) * (bx - x), (ax - x) * (bx - x) + (ay - y) * (by - y));
    }
    return std::abs(turn) > M_PI;
  };
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place;
  int held = 0;
  for (int i = 0; i < 5000; ++i) {
    const double x = place(random), y = place(random);
    held += gate.holds(x, y);
    // The text has six digits: a place so near to an edge would be chance; with this seed there is none.
    EXPECT_EQ(gate.holds(x, y), winds(x, y)) << x << " " << y;
  }
  EXPECT_GT(held, 1000);
}

TEST(PolygonGate, NeighboursShareNoEventAndLoseNone) {
  const PolygonGate left("a,b=0,0:1,0:1,1:0,1"), right("a,b=1,0:2,0:2,1:1,1");
  for (const double y : {0., 0.5, 1.})
    EXPECT_EQ(left.holds(1, y) + right.holds(1, y), y < 1 ? 1 : 0)
        << "the upper end of an edge belongs to the next one";
  EXPECT_FALSE(left.holds(NAN, 0.5) || left.holds(0.5, NAN));
}

TEST(PolygonGate, SaysWhatItIs) {
  EXPECT_EQ(PolygonGate("log:area_um,deform=40,0.01:90,0.01:90,0.1").description(),
            "area_um,deform in a polygon of 3 corners");
}

void expect_refused(const std::string& text, const std::string& words) {
  try {
    static_cast<void>(PolygonGate(text));
    FAIL() << text << " was taken";
  } catch (const UserError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("for example --polygon area_um,deform="), std::string::npos) << said;
  }
}

TEST(PolygonGate, RefusesWhatIsNone) {
  for (const char* text :
       {"", "area_um", "area_um=1,2:3,4:5,6", "=1,2:3,4:5,6", ",b=1,2:3,4:5,6", "log:,b=1,2:3,4:5,6"})
    expect_refused(text, "two features");
  for (const char* text : {"a,b=1,2:3:5,6", "a,b=1,2:3,4:5,x", "a,b=1,2,3:3,4:5,6", "a,b=1,inf:3,4:5,6", "a,b=::"})
    expect_refused(text, "two numbers");
  expect_refused("log:a,b=0,2:3,4:5,6", "positive on a logarithmic axis");
  expect_refused("a,b=1,2:3,4", "three corners");
}

}  // namespace
}  // namespace rheocyte::polygon_gate_test
