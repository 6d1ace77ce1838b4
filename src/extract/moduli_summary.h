// What `rheocyte moduli` says about all events of one recording.
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "events/recording_facts.h"
#include "extract/axial_summary.h"
#include "extract/extract_summary.h"
#include "infer/bulk_cortex_fit.h"
#include "infer/median_cell.h"

namespace rheocyte {

/// Relative standard errors that the moduli of all events of a recording share.
struct CommonErrors {
  double young = no_value, cortex = no_value, stiffness = no_value, effective_modulus = no_value;
};

/// Errors of medians are those of the scatter between events and of what all have in common; those of a law are its
/// own.
struct ModuliSummary : RecordingFacts {
  std::array<std::size_t, moduli_status_count> counts{};  ///< by ModuliStatus
  Distribution young_kPa, cortex_mN_per_m;                ///< of the resolved events
  Distribution stiffness_kPa;  ///< E + E2D / r0 by the law of the cells; without one, of all events that have it
  Distribution effective_modulus_kPa;  ///< likewise
  double outline_noise_um = 0;         ///< as it was given
  std::string settings_hash;           ///< events/settings_hash.h
  std::vector<std::string> warnings;   ///< with the remarks on the recording
  AxialSummary axial;
  MedianCell median_cell;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tuple_cat(RecordingFacts::fields(s),
                          std::tie(s.counts, s.young_kPa, s.cortex_mN_per_m, s.stiffness_kPa, s.effective_modulus_kPa,
                                   s.outline_noise_um, s.settings_hash, s.warnings, s.axial, s.median_cell));
  }

  std::size_t events() const;
  std::size_t resolved() const { return counts[std::size_t(ModuliStatus::resolved)]; }
  /// Events with a stiffness: those whose shape a cell of the table has.
  std::size_t with_stiffness() const { return resolved() + counts[std::size_t(ModuliStatus::not_told_apart)]; }
  bool has_stiffness() const { return axial.law.is_found || with_stiffness() > 0; }
};

/// Takes event by event.
class ModuliTally {
 public:
  void take(const ModuliEstimate& estimate);
  /// Counts and distributions; nothing of gates and warnings. The common errors count where there is no law.
  ModuliSummary summary(const CommonErrors& of_single_cells, const LawOfCells& law);

 private:
  ModuliSummary summary_;
  std::vector<double> young_, cortex_, stiffness_, effective_modulus_;
};

/// What the medians are worth where fewer than half of the events that were fitted have a stiffness; else empty.
std::string missing_text(const ModuliSummary&);

/// For the terminal: how many events are resolved, their moduli, and how many have another status.
std::string in_one_line(const ModuliSummary&);
/// By a table of elongated cells: the axial tension, the effective modulus, the slopes between cells, and the median
/// cell. Empty by another one.
std::vector<std::string> lines_of(const ModuliSummary&);

}  // namespace rheocyte
