// All that is known of one event: its features, its modulus or the reason why there is none, its outline and that of
// the model's cell.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "events/options.h"
#include "measurement/event_outlines.h"
#include "measurement/recording.h"
#include "shelf/modulus_tables.h"
#include "view/recording_columns.h"

namespace rheocyte {

class CombinedCells;
class Extraction;
class ModuliTables;

struct InspectedRecording {
  const Recording& recording;
  ComputedFiles computed = {};
  const ModuliTables* combined = nullptr;  ///< of cells with bulk and cortex; null: none
};

/// One recording with its settings, event after event: what belongs to all of them is found out once.
class EventInspector {
 public:
  /// All must outlive it.
  EventInspector(const InspectedRecording&, const ExtractOptions&, const ModulusTables&);
  ~EventInspector();

  /// {"event", "features", "young_modulus_kPa" and the other columns of tables of events, "sentence", "pixel_um",
  /// "image_size", "outline", "model", "combined", "case"}, with the numbers that `rheocyte extract` with these options
  /// gives for this event; what is not known is null. Lengths in um in the frame of the picture: x along its rows, y
  /// down, from its corner. UserError: no such event, damaged data.
  nlohmann::ordered_json inspect(std::size_t event);

 private:
  nlohmann::ordered_json features(std::size_t event);
  Eigen::MatrixX2d outline(std::size_t event);

  const Recording& recording_;
  const ModulusTables& tables_;
  RecordingColumns columns_;
  double pixel_um_;
  std::optional<EventOutlines> outlines_;
  std::unique_ptr<Extraction> extraction_;  ///< or why there are no moduli:
  std::string missing_;
  std::unique_ptr<CombinedCells> combined_;  ///< null without a combined table
};

/// A picture of one event, "image" or "mask", as PNG. UserError if there is none.
std::string picture_of_event(const Recording& recording, const std::string& feature, std::size_t event);

}  // namespace rheocyte
