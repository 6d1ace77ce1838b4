#include "infer/published_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "case/user_error.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uintmax_t greatest_file = 64 << 20;
constexpr std::string_view begin_metadata = "# BEGIN METADATA", end_metadata = "# END METADATA";

/// A line of the file with its place, for sentences.
class Reader {
 public:
  explicit Reader(const fs::path& file) : name_(one_line(file.string(), 300)), stream_(file, std::ios::binary) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) refuse("there is no such table.");
    if (fs::file_size(file, error) > greatest_file) refuse("is too large for a look-up table.");
    if (!stream_) refuse("cannot be read; check its permissions.");
  }

  bool next() {
    if (!std::getline(stream_, line_)) return false;
    if (line_.ends_with('\r')) line_.pop_back();
    ++number_;
    return true;
  }
  std::string_view line() const { return line_; }
  [[noreturn]] void refuse(const std::string& reason) const {
    throw UserError(number_ == 0 ? fmt::format("{}: {}", name_, reason)
                                 : fmt::format("{}:{}: {}", name_, number_, reason));
  }

 private:
  std::string name_;
  std::ifstream stream_;
  std::string line_;
  int number_ = 0;
};

json parse_metadata(const Reader& reader, const std::string& text) {
  json metadata = json::parse(text, nullptr, false);
  if (!metadata.is_object()) reader.refuse("the metadata between BEGIN and END METADATA are not valid JSON.");
  return metadata;
}

double quantity(const Reader& reader, const json& metadata, const std::string& key, const std::string& unit) {
  const auto value = metadata.find(key), its_unit = metadata.find(key + "_unit");
  if (value == metadata.end() || !value->is_number() || !(value->get<double>() > 0))
    reader.refuse(fmt::format("the metadata need a positive number \"{}\".", key));
  if (its_unit == metadata.end() || *its_unit != unit)
    reader.refuse(fmt::format("the metadata need \"{0}_unit\": \"{1}\"; only {1} is understood.", key, unit));
  return value->get<double>();
}

void take_metadata(const Reader& reader, const json& metadata, const std::string& identifier_key,
                   PublishedTable& table) {
  table.channel_width_um = quantity(reader, metadata, "channel_width", "um");
  table.flow_rate_ul_s = quantity(reader, metadata, "flow_rate", "uL/s");
  table.viscosity_mPas = quantity(reader, metadata, "fluid_viscosity", "mPa s");
  const auto identifier = metadata.find(identifier_key);
  if (identifier == metadata.end() || !identifier->is_string())
    reader.refuse(fmt::format("the metadata need a text \"{}\".", identifier_key));
  table.identifier = one_line(identifier->get<std::string>(), 100);
}

void take_header(const Reader& reader, std::string_view header, PublishedTable& table) {
  while (!header.empty() && (header.front() == '#' || header.front() == ' ')) header.remove_prefix(1);
  if (header == "area_um [um^2]\tdeform\temodulus [kPa]")
    table.abscissa = PublishedTable::Abscissa::area;
  else if (header == "volume [um^3]\tdeform\temodulus [kPa]")
    table.abscissa = PublishedTable::Abscissa::volume;
  else
    reader.refuse(
        "the last comment before the numbers must name the columns, separated by tabs: \"area_um [um^2]\" or "
        "\"volume [um^3]\", \"deform\", \"emodulus [kPa]\".");
}

double next_number(const Reader& reader, std::string_view& rest) {
  while (!rest.empty() && (rest.front() == '\t' || rest.front() == ' ')) rest.remove_prefix(1);
  double value = NAN;
  const char* const start = rest.data() + (rest.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(start, rest.data() + rest.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) reader.refuse("expected three finite numbers, separated by tabs.");
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return value;
}

void take_row(const Reader& reader, PublishedTable& table) {
  std::string_view rest = reader.line();
  const double size = next_number(reader, rest), deformation = next_number(reader, rest);
  const double modulus = next_number(reader, rest);
  if (rest.find_first_not_of(" \t") != std::string_view::npos) reader.refuse("there are more than three columns.");
  if (!(size > 0) || !(modulus > 0)) reader.refuse("sizes and moduli must be positive.");
  table.size.push_back(size);
  table.deformation.push_back(deformation);
  table.modulus_kPa.push_back(modulus);
}

}  // namespace

PublishedTable read_published_table(const fs::path& file, const std::string& identifier_key) {
  Reader reader(file);
  PublishedTable table;
  std::string metadata, header;
  bool in_metadata = false, had_metadata = false;
  while (reader.next()) {
    const std::string_view line = reader.line();
    if (line == begin_metadata) {
      in_metadata = true;
    } else if (line == end_metadata && in_metadata) {
      in_metadata = false;
      had_metadata = true;
      take_metadata(reader, parse_metadata(reader, metadata), identifier_key, table);
    } else if (line.starts_with('#')) {
      if (in_metadata) metadata += std::string(line.substr(1)) + "\n";
      if (!in_metadata) header = line;
    } else if (line.find_first_not_of(" \t") != std::string_view::npos) {
      if (!had_metadata) reader.refuse("there are no metadata before the numbers; is it a look-up table?");
      if (table.size.empty()) take_header(reader, header, table);
      take_row(reader, table);
    }
  }
  if (!had_metadata) reader.refuse("has no metadata (# BEGIN METADATA ...); is it a look-up table?");
  if (table.size.size() < 3) reader.refuse("has fewer than three rows.");
  if (!(std::ranges::max(table.deformation) > 0)) reader.refuse("no row has a positive deformation.");
  return table;
}

}  // namespace rheocyte
