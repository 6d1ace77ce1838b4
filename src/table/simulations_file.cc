#include "table/simulations_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "measurement/hdf5_handle.h"
#include "table/table_lines.h"
#include "table/table_metadata.h"

namespace rheocyte {

namespace {

constexpr double Pas_per_mPas = 1e-3;

void check(bool good) {
  if (!good) throw std::runtime_error("HDF5 could not make the file of simulations");
}

Hdf5Handle checked(hid_t id) {
  Hdf5Handle handle(id);
  check(bool(handle));
  return handle;
}

void write_attribute(const Hdf5Handle& object, const char* name, hid_t type, const void* value) {
  const auto space = checked(H5Screate(H5S_SCALAR));
  const auto attribute = checked(H5Acreate2(object.get(), name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT));
  check(H5Awrite(attribute.get(), type, value) >= 0);
}

void set(const Hdf5Handle& object, const char* name, double value) {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

// Of fixed length: h5py gives these back as bytes, which the field's programs expect. An empty one has length 1.
void set(const Hdf5Handle& object, const char* name, const std::string& text) {
  const auto type = checked(H5Tcopy(H5T_C_S1));
  check(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)) >= 0);
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD) >= 0);
  write_attribute(object, name, type.get(), text.c_str());
}

// A value and its unit under "<name>_unit".
void set(const Hdf5Handle& object, const std::string& name, double value, const std::string& unit) {
  set(object, name.c_str(), value);
  set(object, (name + "_unit").c_str(), unit);
}

// Without times, which would make equal files differ.
Hdf5Handle timeless(hid_t kind) {
  auto properties = checked(H5Pcreate(kind));
  check(H5Pset_obj_track_times(properties.get(), false) >= 0);
  return properties;
}

Hdf5Handle make_group(const Hdf5Handle& parent, std::size_t number) {
  const auto properties = timeless(H5P_GROUP_CREATE);
  // Makes a group of the newer, compact kind.
  check(H5Pset_link_creation_order(properties.get(), H5P_CRT_ORDER_TRACKED) >= 0);
  return checked(
      H5Gcreate2(parent.get(), fmt::format("{}", number).c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT));
}

void write_coordinates(const Hdf5Handle& group, const Eigen::MatrixX2d& contour) {
  // Columns of the matrix lie one behind the other: the file's rows x and r >= 0.
  Eigen::MatrixX2d upper = contour;
  upper.col(1) = upper.col(1).cwiseMax(0);
  const hsize_t shape[] = {2, hsize_t(upper.rows())};
  const auto space = checked(H5Screate_simple(2, shape, nullptr));
  const auto properties = timeless(H5P_DATASET_CREATE);
  const auto data = checked(
      H5Dcreate2(group.get(), "coords", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT));
  check(H5Dwrite(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, upper.data()) >= 0);
}

void write_simulation(const Hdf5Handle& group, const TableRow& row) {
  set(group, "area", row.at(Measure::area_um2), "um^2");
  set(group, "deformation", row.at(Measure::deformation), "");
  set(group, "volume", row.at(Measure::volume_um3), "um^3");
  set(group, "radius", row.radius_um, "um");
  set(group, "sphere_volume", 4.0 / 3 * std::numbers::pi * std::pow(row.radius_um, 3), "um^3");
  set(group, "deformation_error", row.state.error);
  set(group, "regularised", double(row.state.regularised));
  write_coordinates(group, interpolate_contour(*row.state.branch, row.state.stiffness));
}

// Numbers and texts only: the field's programs convert every attribute to one of them.
void write_metadata(const Hdf5Handle& root, const LookupTable& table) {
  auto metadata = table_metadata(table.spec, table.program());
  metadata["fluid_viscosity"] = metadata.at("fluid_viscosity").get<double>() * Pas_per_mPas;
  metadata["fluid_viscosity_unit"] = "Pa s";
  for (const auto& [key, value] : metadata.items())
    if (value.is_number())
      set(root, key.c_str(), value.get<double>());
    else
      set(root, key.c_str(), value.is_string() ? value.get<std::string>() : value.dump());
}

void write_groups(const Hdf5Handle& root, const LookupTable& table) {
  const bool solid = stiffness_unit(table.spec) == "kPa";
  std::size_t groups = 0;
  for (const double level : simulation_levels(table)) {
    const auto line = line_at(table, level);
    if (line.empty()) continue;
    const auto group = make_group(root, groups++);
    set(group, "emodulus", 1e3 * level, solid ? "Pa" : "uN/m");
    for (std::size_t i = 0; i < line.size(); ++i) write_simulation(make_group(group, i), line[i]);
  }
}

Hdf5Handle make_file_in_memory() {
  constexpr std::size_t step = 1 << 20;
  const auto access = checked(H5Pcreate(H5P_FILE_ACCESS));
  check(H5Pset_fapl_core(access.get(), step, false) >= 0);
  // HDF5 1.10 gives images of newer formats a wrong checksum (it clears a flag of the superblock in the image only).
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18) >= 0);
  const auto creation = timeless(H5P_FILE_CREATE);
  return checked(H5Fcreate("simulations.h5", H5F_ACC_TRUNC, creation.get(), access.get()));
}

std::string image_of(const Hdf5Handle& file) {
  check(H5Fflush(file.get(), H5F_SCOPE_LOCAL) >= 0);
  const auto size = H5Fget_file_image(file.get(), nullptr, 0);
  check(size > 0);
  std::string bytes(std::size_t(size), '\0');
  check(H5Fget_file_image(file.get(), bytes.data(), bytes.size()) == size);
  return bytes;
}

}  // namespace

std::vector<double> simulation_levels(const LookupTable& table, int count) {
  if (table.rows.empty()) return {};
  const auto stiffness = [](const TableRow& row) { return row.state.stiffness; };
  const auto [softest, stiffest] = std::ranges::minmax(table.rows, {}, stiffness);
  const double ratio = std::log(stiffness(stiffest) / stiffness(softest));
  std::vector<double> levels;
  for (int i = 0; i < count; ++i)
    levels.push_back(std::stod(fmt::format("{:.4g}", stiffness(softest) * std::exp(ratio * (i + 0.5) / count))));
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

std::string simulations_file(const LookupTable& table) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // failures are reported by check()
  const auto file = make_file_in_memory();
  const auto root = checked(H5Gopen2(file.get(), "/", H5P_DEFAULT));
  write_metadata(root, table);
  write_groups(root, table);
  return image_of(file);
}

}  // namespace rheocyte
