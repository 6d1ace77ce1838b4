// Moduli by a second table: where one of the matching liquid and one of a Newtonian liquid are at hand, both are used.
#pragma once
#include <string>
#include <vector>

#include "infer/modulus_map.h"

namespace rheocyte {

/// How far moduli of the events of a recording by two tables differ.
class TableComparison {
 public:
  /// `other`: null if there is none.
  TableComparison(const ModulusMap& used, const ModulusMap* other) : used_(used), other_(other) {}

  bool is_made() const { return other_ != nullptr; }
  /// Moduli by the other table, of the first events of a block.
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events);
  /// An event of this block has such a modulus by the table that is used.
  void take(std::size_t i, double modulus_kPa);
  /// `exponent`: of the medium.
  std::string sentence(double exponent) const;

 private:
  const ModulusMap& used_;
  const ModulusMap* other_;
  std::vector<double> modulus_, standard_error_;
  std::vector<ModulusState> states_;
  double log_ratios_ = 0;
  std::size_t compared_ = 0;
};

}  // namespace rheocyte
