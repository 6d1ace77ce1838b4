// Linear interpolation over a Delaunay triangulation gives back values, planes and nothing outside the convex hull.
#include "infer/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "case/user_error.h"

namespace rheocyte::triangulation_test {
namespace {

struct Cloud {
  std::vector<PlanePoint> points;
  std::vector<double> values;
};

double plane(double x, double y) { return 3 - 2 * x + 0.5 * y; }

Cloud random_cloud(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    const double x = unit(random), y = unit(random) * unit(random);
    cloud.points.push_back({x, y});
    cloud.values.push_back(plane(x, y));
  }
  return cloud;
}

double value_at(const Triangulation& triangulation, double x, double y) {
  double value = 0;
  triangulation.interpolate({&x, 1}, {&y, 1}, {&value, 1});
  return value;
}

TEST(Triangulation, APlaneComesBackToRounding) {
  const Cloud cloud = random_cloud(3000);
  const Triangulation triangulation(cloud.points, cloud.values);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-0.1, 1.1);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = unit(random), y = unit(random), value = value_at(triangulation, x, y);
    if (std::isnan(value)) continue;
    ++inside;
    // Slivers of this cloud magnify rounding by less than 1e4.
    EXPECT_NEAR(value, plane(x, y), 1e-12);
  }
  EXPECT_GT(inside, 3000);
}

TEST(Triangulation, AtThePointsTheValuesComeBack) {
  Cloud cloud = random_cloud(500);
  for (std::size_t i = 0; i < cloud.values.size(); ++i) cloud.values[i] = double(i);
  const Triangulation triangulation(cloud.points, cloud.values);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    EXPECT_NEAR(value_at(triangulation, cloud.points[i].x, cloud.points[i].y), double(i), 1e-9);
}

TEST(Triangulation, TheTrianglesFillTheConvexHullAndNoMore) {
  const Cloud cloud = random_cloud(400);
  const Triangulation triangulation(cloud.points, cloud.values);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-0.1, 1.1);
  for (int i = 0; i < 20000; ++i) {
    const double x = unit(random), y = unit(random);
    const auto border = triangulation.border_at(x);
    const bool inside = y >= border.lower && y <= border.upper;
    EXPECT_EQ(!std::isnan(value_at(triangulation, x, y)), inside) << x << " " << y;
  }
}

TEST(Triangulation, FourPointsOfASquareMakeTwoTriangles) {
  const std::vector<PlanePoint> points{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const Triangulation triangulation(points, std::vector<double>{0, 1, 2, 3});
  EXPECT_EQ(triangulation.triangles(), 2U);
  EXPECT_NEAR(value_at(triangulation, 0.25, 0.5), 1.25, 1e-15);
  EXPECT_EQ(value_at(triangulation, 1, 1), 3) << "corners belong to the hull";
  EXPECT_EQ(value_at(triangulation, 1, 0.5), 2) << "edges too";
}

TEST(Triangulation, WhatIsNotFiniteHasNoValue) {
  const Triangulation triangulation(std::vector<PlanePoint>{{0, 0}, {1, 0}, {0, 1}}, std::vector<double>{1, 1, 1});
  EXPECT_TRUE(std::isnan(value_at(triangulation, NAN, 0.1)));
  EXPECT_TRUE(std::isnan(value_at(triangulation, 0.1, NAN)));
  EXPECT_TRUE(std::isnan(value_at(triangulation, INFINITY, 0.1)));
  EXPECT_TRUE(std::isnan(value_at(triangulation, -1e300, -1e300)));
}

TEST(Triangulation, PointsOnALineAreRefused) {
  const std::vector<double> values{1, 2, 3, 4};
  EXPECT_THROW(Triangulation(std::vector<PlanePoint>{{0, 0}, {1, 1}, {2, 2}, {3, 3}}, values), UserError);
  EXPECT_THROW(Triangulation(std::vector<PlanePoint>{{0, 0}, {1, 1}}, std::span(values).first(2)), UserError);
  EXPECT_THROW(Triangulation(std::vector<PlanePoint>{{0, 0}, {NAN, 1}, {1, 0}, {1, 1}}, values), UserError);
}

TEST(Triangulation, AGridOfPointsOnCommonCirclesIsFilled) {
  Cloud cloud;
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j) {
      cloud.points.push_back({i / 20.0, j / 20.0});
      cloud.values.push_back(plane(i / 20.0, j / 20.0));
    }
  const Triangulation triangulation(cloud.points, cloud.values);
  EXPECT_EQ(triangulation.triangles(), 800U);
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 60; ++j)
      EXPECT_NEAR(value_at(triangulation, i / 60.0, j / 60.0), plane(i / 60.0, j / 60.0), 1e-14);
}

}  // namespace
}  // namespace rheocyte::triangulation_test
