// The likelihood of all events of a recording under one distribution of its cells (docs/theory-populations.md,
// eq:population and eq:kept).
#pragma once
#include <vector>

#include "population/event_nodes.h"
#include "population/kept_share.h"

namespace rheocyte {

class PopulationLikelihood {
 public:
  /// The sample must outlive it. What it returns is the same to the last bit for any number of threads.
  PopulationLikelihood(const Sample& sample, int threads, int nodes = usual_nodes);

  /// Places the nodes of all events, where they stay for all values until the next call; to be called first.
  void place(const CellDistribution& cells);

  struct Value {
    double log_likelihood = 0;
    ParameterVector score = ParameterVector::Zero();
    ParameterMatrix products = ParameterMatrix::Zero();  ///< sum of the outer products of the events' scores
  };
  Value at(const ParameterVector& q) const;
  double log_likelihood(const ParameterVector& q) const { return value(q, false).log_likelihood; }
  /// The observed information: central differences of the score, over these steps.
  ParameterMatrix information(const ParameterVector& q, const ParameterVector& steps) const;

  /// Of all events together.
  double kept_share(const CellDistribution& cells) const;
  /// In the order of the sample's groups and their events.
  std::vector<ShrunkenCell> shrunken(const CellDistribution& cells) const;

 private:
  struct Place {
    const EventGroup* group;
    const SampleEvent* event;
  };
  Value value(const ParameterVector& q, bool with_score) const;
  Value value_of_block(std::size_t block, const CellDistribution& cells, bool with_score) const;
  std::size_t blocks() const;

  const Sample& sample_;
  int threads_, node_count_;
  double events_ = 0;
  std::vector<Place> places_;
  std::vector<EventNodes> nodes_;
  std::vector<KeptShare> kept_;
};

}  // namespace rheocyte
