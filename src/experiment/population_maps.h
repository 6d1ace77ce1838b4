// What the estimator of populations takes the cells of recordings for: one map for each elongation in each channel.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "experiment/population_events.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

/// Maps of cells in the channels, liquids and pixels of recordings; equal ones are made once.
class PopulationMaps {
 public:
  /// `table`: one of elongated cells (given_elongated_table), which is used for all liquids; empty: those of the square
  /// channel that come with the program. UserError if there is none. `outline_noise_um`: OutlineNoise::deviation, for
  /// the asymmetry alone.
  explicit PopulationMaps(StiffnessMeasure by, const std::string& table = {}, double outline_noise_um = 0);

  StiffnessMeasure by() const { return by_; }
  /// In the channel of a recording.
  const SolidMaps& solids(const PopulationEvents& events);
  /// Of an elongation to within the width of its class.
  std::shared_ptr<const ForwardMap> map(const PopulationEvents& events, double elongation);
  /// Of the table: its name, and the relative error of its moduli.
  std::string table(const PopulationEvents& events) const;
  double table_error(const PopulationEvents& events) const;

 private:
  struct Channel {
    std::unique_ptr<const SolidMaps> solids;
    std::map<double, std::shared_ptr<const ForwardMap>> maps;  ///< by elongation
  };
  using Key = std::array<double, 4>;
  static Key key_of(const PopulationEvents& events);
  Channel& channel(const PopulationEvents& events);
  const ElongatedLiquid& liquid(const PopulationEvents& events) const;
  /// Null without noise.
  std::shared_ptr<const OutlineErrors> outline_errors(const PopulationEvents& events);

  StiffnessMeasure by_;
  double outline_noise_um_;
  std::optional<ModulusTables> tables_;  ///< nothing if the user names one
  std::unique_ptr<const ElongatedSolids> given_;
  std::unique_ptr<const ElongatedLiquid> given_liquid_;
  std::map<Key, Channel> channels_;
  std::map<std::tuple<std::string, double, double>, std::shared_ptr<const OutlineErrors>>
      outline_errors_;  ///< by the table, the width of the channel and the size of the pixels, whatever the flow
};

}  // namespace rheocyte
