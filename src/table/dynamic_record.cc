// The ways of a dynamic table's cells, and the table itself, as bytes.
#include <fmt/format.h>

#include <cmath>

#include "case/user_error.h"
#include "store/build_info.h"
#include "store/read_file.h"
#include "table/checked_record.h"
#include "table/dynamic_table.h"
#include "table/table_files.h"

namespace rheocyte {

namespace {

using nlohmann::json;

constexpr std::size_t largest_table = std::size_t{256} << 20U;
constexpr RecordKind course_kind{"rheocyte course", "1", "record of a cell's way",
                                 "delete it, and it is computed again"};
constexpr RecordKind table_kind{"rheocyte dynamic table", "1", "dynamic table",
                                "compute it again with `rheocyte table`, or give another one"};

constexpr std::size_t max_places = 1000;

json course_record(const CellCourse& course) {
  return {{"radius_um", course.cell.radius_um},
          {"young_modulus_kPa", course.cell.young_modulus_kPa},
          {"time_ms", course.cell.time_ms},
          {"status", name(course.status)},
          {"message", course.message},
          {"seconds", course.seconds},
          {"places", course.value.rows()},
          {"value", blob_of({course.value.data(), std::size_t(course.value.size())})}};
}

/// Bounds that the way of every cell keeps, far from what the tables hold; NaN keeps none.
bool is_possible(const Eigen::MatrixXd& value) {
  const auto column = [&](CourseMeasure measure) { return value.col(int(measure)).array(); };
  const auto shape =
      value.middleCols(int(CourseMeasure::mode_2), int(CourseMeasure::velocity) - int(CourseMeasure::mode_2));
  const auto times = column(CourseMeasure::time);
  return value.allFinite() && (shape.array().abs() < 1).all() && (column(CourseMeasure::deformation).abs() < 1).all() &&
         (column(CourseMeasure::area_ratio) > 0.1).all() && (column(CourseMeasure::area_ratio) < 10).all() &&
         (column(CourseMeasure::inertia_ratio) > 0).all() && (column(CourseMeasure::velocity) > 0).all() &&
         times(0) >= 0 && (times.tail(times.size() - 1) > times.head(times.size() - 1)).all();
}

/// A record keeps the shortest digits of its spec, from which the cell is computed again: equal up to rounding.
bool is_cell(const DynamicCell& cell, const DynamicCell& wanted) {
  const auto is_same = [](double one, double other) { return std::abs(one - other) <= 1e-9 * other; };
  return is_same(cell.radius_um, wanted.radius_um) && is_same(cell.young_modulus_kPa, wanted.young_modulus_kPa) &&
         is_same(cell.time_ms, wanted.time_ms);
}

CellCourse course_of(const json& record, const DynamicCell& wanted) {
  const auto status = status_named(record.at("status").get<std::string>());
  const auto places = record.at("places").get<std::size_t>();
  check_record(status && places <= max_places && (*status != Status::converged || places > 0),
               "a number is out of range");
  CellCourse course{{record.at("radius_um"), record.at("young_modulus_kPa"), record.at("time_ms")},
                    *status,
                    record.at("message"),
                    {},
                    record.at("seconds")};
  const auto values = numbers_of(record, "value", places * std::size_t(course_measures));
  course.value = Eigen::Map<const Eigen::MatrixXd>(values.data(), Eigen::Index(places), course_measures);
  check_record(is_cell(course.cell, wanted), "a cell is not the one that its spec has in this place");
  check_record(course.status != Status::converged || is_possible(course.value),
               "the way of a cell contains numbers that no cell has");
  return course;
}

DynamicContent dynamic_content(std::string_view bytes, const std::string& file) {
  const OpenedRecord opened = opened_record(table_kind, bytes);
  DynamicContent content{
      parse_dynamic_spec(opened.record.at("spec").get<std::string>(), file), opened.record.at("program"), {}};
  const DynamicSpec& spec = content.spec;
  constexpr const char* other = "its content does not agree with its spec";
  const json& courses = opened.record.at("courses");
  const std::vector<DynamicCell> wanted = cells_of(spec);
  check_record(opened.spec_hash == spec_hash(spec) && courses.size() == wanted.size(), other);
  for (const json& record : courses) {
    const CellCourse& course = content.courses.emplace_back(course_of(record, wanted[content.courses.size()]));
    check_record(course.status == Status::converged && course.value.rows() == spec.places, other);
  }
  return content;
}

}  // namespace

std::string to_bytes(const CellCourse& course, const std::string& spec_hash) {
  return sealed_record(course_kind, spec_hash, course_record(course));
}

CellCourse course_from_bytes(std::string_view bytes, const std::string& spec_hash, const DynamicCell& wanted,
                             const std::string& name) {
  return read_or_refuse(course_kind, name, [&] {
    const OpenedRecord opened = opened_record(course_kind, bytes);
    if (opened.spec_hash != spec_hash) throw DamagedRecord{"it belongs to another spec"};
    return course_of(opened.record, wanted);
  });
}

std::string dynamic_file_name(const std::string& identifier) { return fmt::format("dynamic_{}.cbor", identifier); }

std::string to_bytes(const DynamicContent& content) {
  json courses = json::array();
  for (const CellCourse& course : content.courses) courses.push_back(course_record(course));
  return sealed_record(table_kind, spec_hash(content.spec),
                       {{"program", content.program}, {"spec", to_toml(content.spec)}, {"courses", courses}});
}

DynamicContent dynamic_from_bytes(std::string_view bytes, const std::string& name) {
  return read_or_refuse(table_kind, name, [&] { return dynamic_content(bytes, name); });
}

DynamicTable read_dynamic_table(const std::filesystem::path& place) {
  namespace fs = std::filesystem;
  fs::path file = place;
  std::error_code error;
  if (const auto tables = table_files(place, "dynamic"); !tables.empty()) file = tables.begin()->second;
  if (!fs::is_regular_file(file, error))
    throw UserError(
        fmt::format("{}: there is no dynamic table here; give the folder of one that `rheocyte table` has "
                    "finished, or its file dynamic_*.cbor.",
                    one_line(place.string(), 300)));
  return DynamicTable(dynamic_from_bytes(content_of_file(file, largest_table), one_line(file.string(), 300)));
}

}  // namespace rheocyte
