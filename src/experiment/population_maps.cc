#include "experiment/population_maps.h"

#include "case/user_error.h"

namespace rheocyte {

PopulationMaps::PopulationMaps(StiffnessMeasure by, const std::string& table, double outline_noise_um)
    : by_(by), outline_noise_um_(outline_noise_um) {
  if (!table.empty()) {
    given_ = std::make_unique<const ElongatedSolids>(given_elongated_table(table));
    given_liquid_ = std::make_unique<const ElongatedLiquid>(*given_, nullptr, nullptr);
    return;
  }
  tables_.emplace(std::string(), Section::square);
  if (!tables_->elongated(1))
    throw UserError(
        "rheocyte: the table of elongated cells (elongated_*.cbor) that comes with the program is missing; populations "
        "rest on it. Install the program again, or name the folder of the tables in RHEOCYTE_TABLES.");
}

const ElongatedLiquid& PopulationMaps::liquid(const PopulationEvents& events) const {
  return given_liquid_ ? *given_liquid_ : *tables_->elongated(events.flow().exponent);
}

PopulationMaps::Key PopulationMaps::key_of(const PopulationEvents& events) {
  return {events.flow().width_um, events.flow().rate_ul_s, events.flow().exponent, events.pixel_size_um};
}

PopulationMaps::Channel& PopulationMaps::channel(const PopulationEvents& events) {
  Channel& channel = channels_[key_of(events)];
  if (!channel.solids)
    channel.solids = std::make_unique<const SolidMaps>(liquid(events), events.flow(),
                                                       SolidImages{events.pixel_size_um, outline_errors(events)}, by_);
  return channel;
}

std::shared_ptr<const OutlineErrors> PopulationMaps::outline_errors(const PopulationEvents& events) {
  if (outline_noise_um_ == 0) return nullptr;
  auto& errors = outline_errors_[{table(events), events.flow().width_um, events.pixel_size_um}];
  if (!errors)
    errors = std::make_shared<const OutlineErrors>(liquid(events).solids().table(), events.flow().width_um,
                                                   events.pixel_size_um, OutlineNoise{.deviation = outline_noise_um_});
  return errors;
}

const SolidMaps& PopulationMaps::solids(const PopulationEvents& events) { return *channel(events).solids; }

std::shared_ptr<const ForwardMap> PopulationMaps::map(const PopulationEvents& events, double elongation) {
  Channel& of_events = channel(events);
  auto& map = of_events.maps[elongation];
  if (!map) map = of_events.solids->at(elongation);
  return map;
}

std::string PopulationMaps::table(const PopulationEvents& events) const {
  return liquid(events).solids().origin().identifier;
}

double PopulationMaps::table_error(const PopulationEvents& events) const {
  return liquid(events).solids().table().error();
}

}  // namespace rheocyte
