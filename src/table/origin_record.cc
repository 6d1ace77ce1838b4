#include "table/origin_record.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "table/checked_record.h"
#include "table/table_metadata.h"

namespace rheocyte {

namespace {

using nlohmann::json;

/// Only in records of square channels; keys stand in the order of their letters, and this one comes first.
constexpr const char *section_key = "channel_section", *square_section = "square";

}  // namespace

TableOrigin origin_of(const TableSpec& spec, std::string_view version) {
  const Case& c = spec.base;
  return {spec.identifier,  model_text(c),      fmt::format("rheocyte {}", version),
          to_toml(spec),    channel_flow_of(c), stiffness_unit(spec) != "kPa",
          c.channel.section};
}

double positive_number(const json& record, const char* key) {
  const double value = record.at(key);
  check_record(value > 0 && std::isfinite(value), "a number is out of range");
  return value;
}

void put_origin(const TableOrigin& o, json& record) {
  record.update({{"identifier", o.identifier},
                 {"model", o.model},
                 {"program", o.program},
                 {"spec", o.spec},
                 {"channel_width_um", o.flow.width_um},
                 {"flow_rate_ul_per_s", o.flow.rate_ul_s},
                 {"viscosity_mPas", o.flow.viscosity_mPas},
                 {"flow_exponent", o.flow.exponent},
                 {"is_shell", o.is_shell}});
  if (o.section == Section::square) record[section_key] = square_section;
}

TableOrigin origin_from(const json& record) {
  TableOrigin o;
  o.identifier = record.at("identifier");
  o.model = record.at("model");
  o.program = record.at("program");
  o.spec = record.at("spec");
  o.flow.width_um = positive_number(record, "channel_width_um");
  o.flow.rate_ul_s = positive_number(record, "flow_rate_ul_per_s");
  o.flow.viscosity_mPas = positive_number(record, "viscosity_mPas");
  o.flow.exponent = positive_number(record, "flow_exponent");
  o.is_shell = record.at("is_shell");
  if (record.contains(section_key)) {
    check_record(record.at(section_key) == square_section, "a section is unknown");
    o.section = Section::square;
  }
  return o;
}

std::string TableOrigin::description() const {
  const auto conditions =
      fmt::format("{} um, {} ul/s, {:.6g} mPa s", flow.width_um, flow.rate_ul_s, flow.viscosity_mPas);
  return model.empty() ? fmt::format("{} ({})", identifier, conditions)
                       : fmt::format("{} ({}, {}, by {})", identifier, model, conditions, program);
}

std::string TableOrigin::cells() const { return cells_in_words(model, section); }

std::string cells_in_words(std::string_view model, Section section) {
  std::string cells(model.substr(0, model.find(" / ")));
  if (cells.empty()) return cells;
  for (const auto& [written, name] : {std::pair<std::string_view, std::string_view>{"neo-hookean", "neo-Hookean"},
                                      {"mooney-rivlin", "Mooney-Rivlin"},
                                      {"fung", "Fung"}})
    if (const auto at = cells.find(written); at != std::string::npos) cells.replace(at, written.size(), name);
  return fmt::format("{}s in the {}", cells, section == Section::square ? "square channel" : "tube");
}

std::optional<GridHead> grid_head(std::string_view head) {
  head = head.substr(0, grid_head_bytes);
  constexpr std::size_t longest = 200;  // bytes of CBOR
  const auto value_of = [head](std::string_view key) {
    const auto place = head.find(key);
    if (place == std::string_view::npos) return json();
    const auto value = head.substr(place + key.size(), longest);
    constexpr unsigned char first_of_lists = 0x80, first_of_numbers = 0xe0;  // lists would let the reader nest
    if (value.empty() || (static_cast<unsigned char>(value.front()) >= first_of_lists &&
                          static_cast<unsigned char>(value.front()) < first_of_numbers))
      return json();
    return json::from_cbor(value.begin(), value.end(), false, false);
  };
  const json exponent = value_of("flow_exponent"), model = value_of("model");
  if (!exponent.is_number() || !model.is_string()) return {};
  return GridHead{exponent.get<double>(),
                  head.find(section_key) != std::string_view::npos ? Section::square : Section::tube,
                  model.get<std::string>()};
}

}  // namespace rheocyte
