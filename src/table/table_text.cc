#include "table/table_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "numeric/number_from_chars.h"
#include "store/read_file.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view begin_mark = "# BEGIN METADATA", end_mark = "# END METADATA";
constexpr std::size_t max_bytes = 1 << 28;

[[noreturn]] void refuse(const std::string& place, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", place, reason));
}

std::string_view column_names(Abscissa abscissa) {
  return abscissa == Abscissa::area ? "area_um [um^2]\tdeform\temodulus [kPa]"
                                    : "volume [um^3]\tdeform\temodulus [kPa]";
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view without_hash(std::string_view line) {
  line.remove_prefix(1);
  if (line.starts_with(' ')) line.remove_prefix(1);
  return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

// Goes line by line over the text and keeps what it meets.
class TextReader {
 public:
  TextReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  TableText read() {
    while (!text_.empty()) {
      const auto end = text_.find('\n');
      const auto line = text_.substr(0, end);
      text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
      ++line_;
      if (trim(line).empty()) continue;
      if (line.starts_with('#'))
        take_comment(line);
      else
        take_row(trim(line));
    }
    if (table_.rows.empty()) refuse(name_, "contains no rows; is it a look-up table in dclab's format?");
    return std::move(table_);
  }

 private:
  std::string place() const { return fmt::format("{}:{}", name_, line_); }

  void take_comment(std::string_view line) {
    if (!table_.rows.empty()) return;
    if (line.starts_with(begin_mark)) {
      stage_ = Stage::metadata;
    } else if (line.starts_with(end_mark)) {
      stage_ = Stage::after;
      parse_metadata();
    } else if (stage_ == Stage::metadata) {
      json_ += std::string(without_hash(line)) + "\n";
    } else if (stage_ == Stage::before) {
      table_.comments.emplace_back(without_hash(line));
    } else {
      last_comment_ = std::string(without_hash(line));
    }
  }

  void parse_metadata() {
    table_.metadata = parse_sound_json(json_);
    if (!table_.metadata.is_object()) refuse(place(), "the metadata above are not valid JSON.");
    for (const auto& [key, unit] :
         {std::pair("channel_width", "um"), std::pair("flow_rate", "uL/s"), std::pair("fluid_viscosity", "mPa s")}) {
      const auto value = table_.metadata.find(key);
      if (value == table_.metadata.end() || !value->is_number() || !(value->get<double>() > 0))
        refuse(place(), fmt::format("the metadata above have no positive number \"{}\".", key));
      if (table_.metadata.value(std::string(key) + "_unit", nlohmann::ordered_json()) != unit)
        refuse(place(), fmt::format("the metadata above do not say \"{}_unit\": \"{}\".", key, unit));
    }
    const auto is_text = [&](const char* key) {
      const auto value = table_.metadata.find(key);
      return value != table_.metadata.end() && value->is_string();
    };
    if (!is_text(table_identifier_key) && !is_text(lines_identifier_key))
      refuse(place(), "the metadata above have no \"identifier\".");
  }

  void check_columns() {
    if (stage_ != Stage::after) refuse(place(), "a row before \"# END METADATA\"; a table begins with its metadata.");
    for (const auto abscissa : {Abscissa::area, Abscissa::volume})
      if (last_comment_ == column_names(abscissa)) {
        table_.abscissa = abscissa;
        return;
      }
    refuse(place(),
           "the line of comment above the rows must name the columns area_um [um^2] or volume [um^3], deform, "
           "emodulus [kPa], with tabs between.");
  }

  void take_row(std::string_view line) {
    if (table_.rows.empty()) check_columns();
    std::array<double, 3> row{};
    for (double& value : row) {
      if (line.starts_with('+')) line.remove_prefix(1);  // which from_chars does not know
      const auto [end, error] = number_from_chars(line.data(), line.data() + line.size(), value);
      const bool ends = end == line.data() + line.size() || *end == ' ' || *end == '\t';
      if (error != std::errc{} || !ends || !std::isfinite(value)) refuse(place(), "does not hold three numbers.");
      line = trim(line.substr(std::size_t(end - line.data())));
    }
    if (!line.empty()) refuse(place(), "holds more than three numbers.");
    // Lines may begin where the cell has no size, as those of closed formulas do.
    const bool may_be_zero = table_.metadata.contains(lines_identifier_key);
    if (!(row[0] > 0 || (row[0] == 0 && may_be_zero)) || !(row[2] > 0))
      refuse(place(), "sizes and moduli must be positive.");
    table_.rows.push_back(row);
  }

  enum class Stage { before, metadata, after } stage_ = Stage::before;
  std::string_view text_;
  const std::string& name_;
  long line_ = 0;
  std::string json_, last_comment_;
  TableText table_;
};

}  // namespace

std::string to_text(const TableText& table) {
  std::string text;
  const auto add_comment = [&](std::string_view line) {
    text += fmt::format("#{}{}\n", line.empty() ? "" : " ", line);
  };
  for (const auto& comment : table.comments) add_comment(comment);
  text += fmt::format("{}\n", begin_mark);
  std::string json = json_text(table.metadata, JsonCharacters::ascii) + "\n";
  for (std::string_view rest = json; !rest.empty(); rest.remove_prefix(rest.find('\n') + 1))
    add_comment(rest.substr(0, rest.find('\n')));
  text += fmt::format("{}\n#\n", end_mark);
  add_comment(column_names(table.abscissa));
  for (const auto& [x, deformation, modulus] : table.rows)
    text += fmt::format("{:.9e}\t{:.9e}\t{:.9e}\n", x, deformation, modulus);
  return text;
}

TableText parse_table_text(std::string_view text, const std::string& name) { return TextReader(text, name).read(); }

TableText read_table_text(const fs::path& file) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) refuse(name, "there is no such table.");
  if (error) refuse(name, fmt::format("cannot read the table ({}).", error.message()));
  if (!fs::is_regular_file(status)) refuse(name, "is not a regular file; give a table such as lut_LE-2D-26.txt.");
  return parse_table_text(content_of_file(file, max_bytes), name);
}

}  // namespace rheocyte
