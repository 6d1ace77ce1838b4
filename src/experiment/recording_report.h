// What one recording says about its cells as a population.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "events/events_beyond.h"
#include "events/recording_facts.h"
#include "experiment/population_check.h"
#include "experiment/population_events.h"
#include "extract/effective_cell.h"
#include "infer/combined_population.h"
#include "numeric/no_value.h"
#include "population/comparison.h"
#include "population/fit_cells.h"
#include "population/single_images.h"

namespace rheocyte {

/// By what conditions are compared: numbers of cells whose logarithms have a mean and a spread in each recording. The
/// tension is that of the cortex, the axial tension that of the liquid.
enum class PopulationQuantity {
  young_modulus,
  stiffness,
  effective_modulus,
  cortex_modulus,
  cortex_tension,
  axial_tension,
  count
};
struct QuantityWords {
  std::string_view name, suffix;  ///< of columns: the quantity, and its unit
  std::string_view symbol, unit;
};
QuantityWords words_of(PopulationQuantity quantity);

/// Of ln of a quantity among the cells of a recording.
struct QuantityEstimate {
  PopulationQuantity quantity;
  RecordingMean mean;                                  ///< the variance is that of its events
  double spread = 0;                                   ///< standard deviation between cells
  double common_error = 0;                             ///< standard error that recordings of one set-up share
  std::optional<ParameterInterval> log_interval = {};  ///< of the mean; not given: its error is normal
};

/// The median of ln of a quantity is below it.
struct UpperBound {
  PopulationQuantity quantity;
  double log;
};

/// Of cells with a cortex.
struct CombinedReport {
  CombinedPopulation found;
  Section section = Section::square;
  double wall_stress_Pa = 0;
  std::size_t strangers = 0;
  std::string not_told;  ///< why bulk and cortex cannot be separated, in words; empty if they are
};

/// One recording; its events stay outside.
struct RecordingReport : RecordingFacts {
  std::filesystem::path recording;
  std::size_t condition = 0, session = 0;  ///< counted from 0
  double median_viscosity_mPas = 0, median_elongation = 0;
  std::string table;
  std::size_t without_numbers = 0, fitted_events = 0;
  EventsBeyond beyond;               ///< the cells of the table
  std::size_t continued_events = 0;  ///< of these: fitted nevertheless, because the table goes straight on to them
  bool is_binned = false;
  std::vector<QuantityEstimate> quantities;  ///< the first one is the one that the model knows best
  double log_radius = no_value, radius_spread = no_value;
  std::array<Median, seen_measures> observed = {};   ///< medians of what is measured, NaN of what is not
  CensoredMedian by_deformation_kPa, elongated_kPa;  ///< E of solids, by `rheocyte extract`
  std::vector<MeasureCheck> checks;
  std::vector<std::string> warnings;  ///< with the remarks on the recording
  std::string settings_hash;          ///< events/settings_hash.h
  std::string failure;                ///< why there is no number, in a sentence; else empty
  /// Of a failure: the cells are known to lie on one side of those that have a number, so that recordings without this
  /// one would be a selection.
  bool is_beyond = false;
  std::optional<UpperBound> bound;  ///< of such softer cells

  FittedCells fitted;  ///< of solids
  SingleImages images;
  std::vector<std::size_t> shrunken_events;  ///< number of the event, from 1 on, of each of fitted.shrunken
  std::optional<CombinedReport> combined;    ///< of cells with a cortex
  std::optional<EffectiveCell> effective;    ///< of the median cell

  const QuantityEstimate* estimate(PopulationQuantity quantity) const;
  /// Inside the gates and with numbers.
  std::size_t seen_events() const { return fitted_events + beyond.all() - continued_events; }
  /// At the wall without a cell, at the median viscosity.
  double wall_stress_Pa() const;
};

}  // namespace rheocyte
