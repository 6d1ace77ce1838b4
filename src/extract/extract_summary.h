// What is said about all events of one recording, and the table with a line for each recording.
#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "extract/extract_settings.h"
#include "infer/modulus_state.h"

namespace rheocyte {

/// Of the events with a modulus (kPa); NaN if there are none, the standard deviation (n - 1) also for a single one.
struct Distribution {
  double median = 0, first_quartile = 0, third_quartile = 0, mean = 0, standard_deviation = 0;
};

/// Sorts the values. Quartiles between two values are interpolated linearly.
Distribution distribution_of(std::span<double> values);

struct ExtractSummary {
  std::size_t events = 0;
  std::array<std::size_t, names_of_modulus_states.size()> counts{};  ///< by ModulusState
  Distribution modulus_kPa;
  double median_standard_error_kPa = 0;  ///< of the events with a modulus; NaN if unknown
  double mean_viscosity_mPas = 0;
  std::string table, medium, viscosity_model, temperature, area_from, deformation_from;
  std::string corrected;  ///< for the pixels: "area and deformation", "deformation", "nothing"
  std::string gates;      ///< limits of the events that count; empty: all
  MeasuringConditions conditions;
  std::vector<std::string> warnings;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.events, s.counts, s.modulus_kPa, s.median_standard_error_kPa, s.mean_viscosity_mPas, s.table,
                    s.medium, s.viscosity_model, s.temperature, s.area_from, s.deformation_from, s.corrected, s.gates,
                    s.conditions, s.warnings);
  }

  /// Events with a modulus, those of regularised states included.
  std::size_t valid() const { return counts[0] + counts[static_cast<std::size_t>(ModulusState::regularised)]; }
};

/// One recording of the summary table; `error` says why there is nothing else.
struct SummaryLine {
  std::filesystem::path recording;
  ExtractSummary summary;
  std::string error;
};

/// Tab-separated text with a header line.
std::string summary_table(std::span<const SummaryLine> lines);

/// For the terminal: numbers of events and moduli in one line.
std::string in_one_line(const ExtractSummary&);

}  // namespace rheocyte
