// What is said about all events of one recording.
#pragma once
#include <array>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "events/recording_facts.h"
#include "extract/distribution.h"
#include "extract/shape_verdict.h"
#include "infer/modulus_state.h"

namespace rheocyte {

struct ExtractSummary : RecordingFacts {
  std::array<std::size_t, names_of_modulus_states.size()> counts{};  ///< by ModulusState
  Distribution modulus_kPa;
  double median_standard_error_kPa = 0;  ///< of the events with a modulus; NaN if unknown
  double mean_viscosity_mPas = 0;
  ShapeVerdict shapes;
  std::string table;
  std::string corrected;              ///< for the pixels: "area and deformation", "deformation", "nothing"
  std::string settings_hash;          ///< events/settings_hash.h
  std::vector<std::string> warnings;  ///< with the remarks on the recording

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tuple_cat(RecordingFacts::fields(s),
                          std::tie(s.counts, s.modulus_kPa, s.median_standard_error_kPa, s.mean_viscosity_mPas,
                                   s.shapes, s.table, s.corrected, s.settings_hash, s.warnings));
  }

  /// Events with a modulus, whatever is said about it.
  std::size_t with_modulus() const {
    std::size_t sum = 0;
    for (std::size_t k = 0; k < counts.size(); ++k)
      if (has_modulus(static_cast<ModulusState>(k))) sum += counts[k];
    return sum;
  }
};

/// For the terminal: numbers of events and moduli in one line.
std::string in_one_line(const ExtractSummary&);

}  // namespace rheocyte
