// The cell with bulk and cortex that an event is, by a combined table: the moduli of `rheocyte moduli`, and its
// outline.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "events/event_reader.h"
#include "extract/event_moduli.h"

namespace rheocyte {

struct CombinedCell {
  /// {"table", "status", "sentence", "young_modulus_kPa", "cortex_modulus_mN_per_m", "tension_mN_per_m",
  /// "stiffness_kPa", "effective_modulus_kPa", their errors, "chi_squared", "case"}; null where nothing was fitted.
  nlohmann::ordered_json told;
  /// In um about the centroid of its hull, x along the flow, downstream; without rows where no cell of the table has
  /// such a shape.
  Eigen::MatrixX2d outline;
};

class CombinedCells {
 public:
  /// The recording has outlines (asserted). Recording and tables must outlive it. UserError as of `rheocyte moduli`.
  CombinedCells(const Recording&, const MeasuringOptions&, const ModuliTables&);

  /// UserError if the data are damaged.
  CombinedCell at(std::size_t event);

 private:
  nlohmann::ordered_json case_of(const ModuliEstimate&, double viscosity_mPas) const;
  Eigen::MatrixX2d outline_of(const ModuliEstimate&) const;

  EventReader events_;
  Section section_;
  const ModuliTable& table_;
  EventModuli moduli_;
};

}  // namespace rheocyte
