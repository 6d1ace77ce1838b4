// What cells look like along the channel behind a contraction, for all radii, moduli and viscosities: a dynamic table
// (docs/tables.md, sec. "dynamic tables").
#pragma once
#include <Eigen/Core>
#include <array>
#include <atomic>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "state/outcome.h"
#include "table/dynamic_spec.h"

namespace rheocyte {

/// What is known at a place: of the convex hull, and on the way there. Modes are those of a cell that moves towards +x.
enum class CourseMeasure {
  deformation,
  area_ratio,
  inertia_ratio,
  mode_2,
  mode_3,
  mode_4,
  mode_5,
  mode_6,
  mode_7,
  velocity,
  time,
  count
};
inline constexpr int course_measures = int(CourseMeasure::count);

/// One cell on its way: places x measures; area over that of the sphere at rest, velocity in U, time in R/U.
struct CellCourse {
  DynamicCell cell;
  Status status = Status::not_started;
  std::string message;
  Eigen::MatrixXd value;
  double seconds = 0;
};

/// How far the cells that were computed to compare with lie from the interpolation; in parts of the greatest value on
/// each way.
struct CourseErrors {
  int cells = 0;
  double mode_3 = 0, deformation = 0;
};

/// All that the file of a dynamic table holds: a course for each of cells_of(spec).
struct DynamicContent {
  DynamicSpec spec;
  std::string program;  ///< name and version
  std::vector<CellCourse> courses;
};

/// Polynomials in radius, ln(E) and ln(3 eta / E) through all nodes; cubic between four places.
class DynamicTable {
 public:
  /// Every course must have come to its end (asserted).
  explicit DynamicTable(DynamicContent content);

  const DynamicContent& content() const { return content_; }
  const DynamicSpec& spec() const { return content_.spec; }
  const CourseErrors& errors() const { return errors_; }

  /// Whether a radius, and a place behind the contraction, are in the table (um).
  bool has_radius(double radius_um) const;
  bool has_place(double place_um) const;

  /// At one place behind the contraction, which the table must have.
  double value(CourseMeasure, const DynamicCell&, double place_um) const;

  /// Of one radius at one place: E x times, at the coordinates that are given. What lies outside the table counts as
  /// its border.
  Eigen::MatrixXd values(CourseMeasure, double radius_um, double place_um, std::span<const double> log_modulus,
                         std::span<const double> log_time) const;

 private:
  CourseErrors compare() const;

  DynamicContent content_;
  std::array<std::vector<double>, 3> axes_;
  std::vector<double> places_;
  CourseErrors errors_;
};

std::string to_bytes(const CellCourse&, const std::string& spec_hash);
/// UserError naming `name` if the bytes are damaged, of another spec or cell, or hold numbers that no cell has.
CellCourse course_from_bytes(std::string_view bytes, const std::string& spec_hash, const DynamicCell& wanted,
                             const std::string& name);

/// Name of the file beside the spec: dynamic_<identifier>.cbor.
std::string dynamic_file_name(const std::string& identifier);
std::string to_bytes(const DynamicContent&);
/// UserError naming `name` if the bytes are damaged or no dynamic table, or hold other cells than the spec, or numbers
/// that no cell has.
DynamicContent dynamic_from_bytes(std::string_view bytes, const std::string& name);
/// Of a folder of `rheocyte table`, or the file itself. UserError.
DynamicTable read_dynamic_table(const std::filesystem::path&);

}  // namespace rheocyte
