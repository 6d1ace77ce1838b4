// The fraction of a population's cells whose measured values pass the gates, and its slopes
// (docs/theory-populations.md, eq:kept).
#pragma once
#include <vector>

#include "population/cell_distribution.h"
#include "population/sample.h"

namespace rheocyte {

class KeptFraction {
 public:
  /// Tabulates the chance of each cell to pass on a grid that resolves the gates' edges.
  explicit KeptFraction(const KeptClass& kept);

  struct Answer {
    double fraction;
    ParameterVector score;  ///< of ln(fraction)
  };
  Answer answer(const CellDistribution& cells, bool with_score) const;

 private:
  struct Row {
    double log_radius, width;  ///< of the cells of this row
    double soft_end;           ///< ln E at height 0
    std::size_t first, count;  ///< of the chances, where they are not 0
    std::size_t first_height;
  };
  /// Heights of equal distance.
  struct Stretch {
    std::size_t begin, end;
    double step;
  };
  /// Of the chances of a row times the density of t, times 1, t and t^2: t is (e - its mean at this u) over its
  /// standard deviation there.
  struct RowSums {
    double all = 0, first = 0, second = 0;
  };
  std::vector<float> chances_at(const KeptClass& kept, double log_radius) const;
  RowSums sums_of(const Row& row, const CellDistribution& cells, double zu) const;

  std::vector<double> heights_;
  std::vector<Stretch> stretches_;
  std::vector<Row> rows_;
  std::vector<float> chances_;
};

}  // namespace rheocyte
