// The file of simulations can be read back: attributes with their units, contours with the stated area, equal bytes.
#include "table/simulations_file.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include "invented_branch.h"
#include "measurement/hdf5_handle.h"

namespace rheocyte::simulations_file_test {
namespace {

using namespace test;

TableSpec small_spec() {
  return parse_table_spec(short_spec, "spec.toml",
                          std::vector<std::string>{"table.radii=6", "table.rows_per_radius=20"});
}

std::string bytes_of(const TableSpec& spec, const std::vector<SampledBranch>& branches) {
  return simulations_file(make_lookup_table(spec, branches, "0"));
}

Hdf5Handle open(const std::string& bytes) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fapl_core(access.get(), 1 << 20, false);
  H5Pset_file_image(access.get(), const_cast<char*>(bytes.data()), bytes.size());
  return Hdf5Handle(H5Fopen("image.h5", H5F_ACC_RDONLY, access.get()));
}

double number(const Hdf5Handle& file, const std::string& group, const char* name) {
  const Hdf5Handle attribute(H5Aopen_by_name(file.get(), group.c_str(), name, H5P_DEFAULT, H5P_DEFAULT));
  double value = std::nan("");
  if (attribute) H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::string text(const Hdf5Handle& file, const std::string& group, const char* name) {
  const Hdf5Handle attribute(H5Aopen_by_name(file.get(), group.c_str(), name, H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute) return "missing";
  const Hdf5Handle type(H5Aget_type(attribute.get()));
  if (H5Tis_variable_str(type.get()) != 0) return "of variable length";
  std::string value(H5Tget_size(type.get()), '?');
  H5Aread(attribute.get(), type.get(), value.data());
  return value.c_str();
}

hsize_t members(const Hdf5Handle& file, const std::string& group) {
  const Hdf5Handle handle(H5Gopen2(file.get(), group.c_str(), H5P_DEFAULT));
  H5G_info_t info{};
  return H5Gget_info(handle.get(), &info) >= 0 ? info.nlinks : 0;
}

TEST(SimulationsFile, ConditionsStandAtTheRootWithTheirUnits) {
  const auto spec = small_spec();
  const auto file = open(bytes_of(spec, invented_branches(spec)));
  ASSERT_TRUE(bool(file));
  EXPECT_EQ(number(file, "/", "channel_width"), 20);
  EXPECT_EQ(text(file, "/", "channel_width_unit"), "um");
  EXPECT_EQ(number(file, "/", "flow_rate"), 0.04);
  EXPECT_EQ(text(file, "/", "flow_rate_unit"), "uL/s");
  EXPECT_DOUBLE_EQ(number(file, "/", "fluid_viscosity"), 0.015);
  EXPECT_EQ(text(file, "/", "fluid_viscosity_unit"), "Pa s");
  EXPECT_EQ(text(file, "/", "identifier"), "XX-2D-26");
  EXPECT_EQ(text(file, "/", "dimensionality"), "2Daxis");
}

TEST(SimulationsFile, SimulationsAreStatesOfTheBranches) {
  const auto spec = small_spec();
  const auto file = open(bytes_of(spec, invented_branches(spec, 60)));
  const auto groups = members(file, "/");
  ASSERT_GT(groups, 30u);
  int simulations = 0;
  for (hsize_t g = 0; g < groups; ++g) {
    const std::string group = std::string("/") + std::to_string(g);
    EXPECT_EQ(text(file, group, "emodulus_unit"), "Pa");
    const double modulus_kPa = number(file, group, "emodulus") / 1e3;
    for (hsize_t s = 0; s < members(file, group); ++s, ++simulations) {
      const auto path = group + "/" + std::to_string(s);
      EXPECT_EQ(text(file, path, "area_unit"), "um^2");
      EXPECT_EQ(text(file, path, "deformation_unit"), "");
      EXPECT_EQ(text(file, path, "volume_unit"), "um^3");
      const double radius = number(file, path, "radius");
      // Cubic interpolation between 60 samples.
      EXPECT_NEAR(number(file, path, "deformation") / invented_deformation(radius, modulus_kPa), 1, 2e-6);
      EXPECT_NEAR(number(file, path, "volume") / number(file, path, "sphere_volume"), 1, 1e-12);  // rounding
    }
  }
  EXPECT_GT(simulations, 100);
}

TEST(SimulationsFile, ContoursAreHalfContoursFromTheFrontToTheRear) {
  const auto spec = small_spec();
  const auto file = open(bytes_of(spec, invented_branches(spec)));
  const Hdf5Handle data(H5Dopen2(file.get(), "/5/0/coords", H5P_DEFAULT));
  const Hdf5Handle space(H5Dget_space(data.get()));
  hsize_t shape[2] = {};
  ASSERT_EQ(H5Sget_simple_extent_dims(space.get(), shape, nullptr), 2);
  ASSERT_EQ(shape[0], 2u);
  std::vector<double> values(2 * shape[1]);
  H5Dread(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  const double radius = number(file, "/5/0", "radius"), d = number(file, "/5/0", "deformation");
  const auto exact = invented_contour(radius, d);
  for (hsize_t i = 0; i < shape[1]; ++i) {  // um; cubic interpolation between 24 samples
    EXPECT_NEAR(values[i], exact(Eigen::Index(i), 0), 1e-3);
    EXPECT_NEAR(values[shape[1] + i], exact(Eigen::Index(i), 1), 1e-3);
    EXPECT_GE(values[shape[1] + i], 0);
  }
}

TEST(SimulationsFile, EqualTablesGiveEqualBytes) {
  const auto spec = small_spec();
  const auto first = bytes_of(spec, invented_unstable_branches(spec));
  const std::vector<std::string> disturb(1000, std::string(777, 'x'));  // another state of the heap
  EXPECT_EQ(bytes_of(spec, invented_unstable_branches(spec)), first);
}

TEST(SimulationsFile, ShellsHaveTheirOwnUnit) {
  const auto spec =
      parse_table_spec(short_spec, "spec.toml",
                       std::vector<std::string>{"cell.bulk.law=none", "cell.cortex.law=linear", "table.radii=4"});
  const auto file = open(bytes_of(spec, invented_branches(spec)));
  EXPECT_EQ(text(file, "/0", "emodulus_unit"), "uN/m");
}

}  // namespace
}  // namespace rheocyte::simulations_file_test
