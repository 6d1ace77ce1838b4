// The ways of a dynamic table's cells, and the table itself, as bytes.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "case/user_error.h"
#include "store/build_info.h"
#include "table/checked_record.h"
#include "table/dynamic_table.h"

namespace rheocyte {

namespace {

using nlohmann::json;

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

CellCourse course_of(const json& record) {
  const auto status = status_named(record.at("status").get<std::string>());
  const auto places = record.at("places").get<std::size_t>();
  if (!status || places > max_places || (*status == Status::converged && places == 0))
    throw DamagedRecord{"a number is out of range"};
  CellCourse course{{record.at("radius_um"), record.at("young_modulus_kPa"), record.at("time_ms")},
                    *status,
                    record.at("message"),
                    {},
                    record.at("seconds")};
  const auto values = numbers_of(record, "value", places * std::size_t(course_measures));
  course.value = Eigen::Map<const Eigen::MatrixXd>(values.data(), Eigen::Index(places), course_measures);
  if (!course.value.allFinite()) throw DamagedRecord{"a number is out of range"};
  return course;
}

DynamicContent dynamic_content(std::string_view bytes, const std::string& file) {
  const OpenedRecord opened = opened_record(table_kind, bytes);
  DynamicContent content{
      parse_dynamic_spec(opened.record.at("spec").get<std::string>(), file), opened.record.at("program"), {}};
  for (const json& record : opened.record.at("courses")) content.courses.push_back(course_of(record));
  const DynamicSpec& spec = content.spec;
  const auto is_whole = [&](const CellCourse& course) {
    return course.status == Status::converged && course.value.rows() == spec.places;
  };
  if (opened.spec_hash != spec_hash(spec) || int(content.courses.size()) != nodes(spec) + spec.checks ||
      !std::ranges::all_of(content.courses, is_whole))
    throw DamagedRecord{"it does not hold what its spec says"};
  return content;
}

}  // namespace

std::string to_bytes(const CellCourse& course, const std::string& spec_hash) {
  return sealed_record(course_kind, spec_hash, course_record(course));
}

CellCourse course_from_bytes(std::string_view bytes, const std::string& spec_hash, const std::string& name) {
  return read_or_refuse(course_kind, name, [&] {
    const OpenedRecord opened = opened_record(course_kind, bytes);
    if (opened.spec_hash != spec_hash) throw DamagedRecord{"it belongs to another spec"};
    return course_of(opened.record);
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
  if (fs::is_directory(place, error))
    for (const auto& entry : fs::directory_iterator(place, error)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("dynamic_") && name.ends_with(".cbor")) file = entry.path();
    }
  if (!fs::is_regular_file(file, error))
    throw UserError(
        fmt::format("{}: there is no dynamic table here; give the folder of one that `rheocyte table` has "
                    "finished, or its file dynamic_*.cbor.",
                    one_line(place.string(), 300)));
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return DynamicTable(dynamic_from_bytes(bytes, one_line(file.string(), 300)));
}

}  // namespace rheocyte
