#include "view/describe_item.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "case/json_guard.h"
#include "case/read_case.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "infer/read_modulus_map.h"
#include "measurement/shape_source.h"
#include "store/read_file.h"
#include "table/combined_table.h"
#include "view/recording_columns.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json describe_recording(const fs::path& file) {
  const Recording recording(file);
  const RecordingColumns columns(recording);
  Json metadata = Json::object();
  for (const auto& [key, value] : recording.metadata().values())
    std::visit([&member = metadata[key]](const auto& stored) { member = stored; }, value);
  Json pictures = Json::array();
  for (const char* feature : {"image", "mask"})
    if (recording.image_size(feature)) pictures.push_back(feature);
  return {{"basins", paths_json(recording.files_of_basins())},
          {"events", recording.events()},
          {"conditions", stated_conditions(recording.metadata())},
          {"features", columns.names()},
          {"pictures", pictures},
          {"outlines", ShapeSource::has_outlines(recording)},
          {"remarks", recording.remarks()},
          {"metadata", metadata}};
}

Json describe_result(const fs::path& folder) {
  constexpr std::size_t largest_file = 16 << 20;
  const fs::path file = folder / "result.json";
  const std::string name = one_line(file.string(), 300);
  const Json result = parse_sound_json(content_of_file(file, largest_file));
  if (!result.is_object() || !result.contains("case"))
    throw UserError(fmt::format("{}: contains no result of rheocyte.", name));
  return {{"case", result["case"]}};
}

Json table_conditions(const std::string& identifier, const std::string& model, const ChannelFlow& flow) {
  return {{"conditions",
           {{"table", identifier},
            {"model", model},
            {"channel_width_um", flow.width_um},
            {"flow_rate_ul_per_s", flow.rate_ul_s},
            {"viscosity_mPas", flow.viscosity_mPas},
            {"flow_exponent", flow.exponent}}}};
}

Json describe_table(const fs::path& path) {
  const auto map = read_modulus_map(path);
  const TableOrigin& origin = map->origin();
  return table_conditions(origin.identifier, origin.model, origin.flow);
}

Json describe_combined(const fs::path& folder) {
  const CombinedTable table = read_combined_table(folder);
  return table_conditions(table.spec.identifier, "bulk and cortex", channel_flow_of(table.spec.base));
}

}  // namespace

Json paths_json(std::span<const fs::path> paths) {
  Json names = Json::array();
  for (const auto& path : paths) names.push_back(path.string());
  return names;
}

Json stated_conditions(const Metadata& metadata) {
  Json conditions;
  for (const auto& [name, key] :
       {std::pair("channel_width_um", "setup:channel width"), std::pair("flow_rate_ul_per_s", "setup:flow rate"),
        std::pair("temperature_C", "setup:temperature"), std::pair("pixel_um", "imaging:pixel size")}) {
    const auto number = metadata.number(key);
    conditions[name] = number ? Json(*number) : Json();
  }
  for (const auto& [name, key] : {std::pair("medium", "setup:medium"), std::pair("region", "setup:chip region"),
                                  std::pair("sample", "experiment:sample"), std::pair("date", "experiment:date"),
                                  std::pair("time", "experiment:time"), std::pair("run", "experiment:run index")}) {
    const auto text = metadata.text(key);
    conditions[name] = text ? Json(*text) : Json();
  }
  return conditions;
}

Json describe_item(const ItemPlace& place) {
  if (!place.error.empty()) throw UserError(place.error);
  switch (place.kind) {
    case ItemKind::case_file: return {{"case", to_json(read_case(place.path))}};
    case ItemKind::result: return describe_result(place.path);
    case ItemKind::table: return describe_table(place.path);
    case ItemKind::combined: return describe_combined(place.path);
    default: return describe_recording(place.path);
  }
}

}  // namespace rheocyte
