// The likelihood of all events of a recording under one distribution of its cells (docs/theory-populations.md,
// eq:population and eq:kept).
#pragma once
#include <vector>

#include "population/event_nodes.h"
#include "population/kept_fraction.h"

namespace rheocyte {

class PopulationLikelihood {
 public:
  /// The sample must outlive it. What it returns is the same to the last bit for any number of threads.
  PopulationLikelihood(const Sample& sample, int threads, int nodes = usual_nodes);

  /// Places the nodes of all events, where they stay for all values until the next call; to be called first.
  void place(const CellLaw& law);

  struct Value {
    double log_likelihood = 0;
    LawVector score = LawVector::Zero();
    LawMatrix products = LawMatrix::Zero();  ///< sum of the outer products of the events' scores
  };
  Value at(const LawVector& q) const;
  double log_likelihood(const LawVector& q) const { return value(q, false).log_likelihood; }
  /// The observed information: central differences of the score, over these steps.
  LawMatrix information(const LawVector& q, const LawVector& steps) const;

  /// Of all events together.
  double kept_fraction(const CellLaw& law) const;
  /// Mean and variance of the elongation before the gates, which may keep more of the short cells than of the long
  /// ones.
  struct Elongations {
    double mean = 0, variance = 0;
  };
  Elongations elongations(const CellLaw& law) const;
  /// In the order of the sample's groups and their events.
  std::vector<ShrunkenCell> shrunken(const CellLaw& law) const;

 private:
  struct Place {
    const EventGroup* group;
    const SampleEvent* event;
  };
  CellDistribution cells_of(std::size_t kept_class, const CellLaw& law) const;
  Value value(const LawVector& q, bool with_score) const;
  Value value_of_block(std::size_t block, const CellLaw& law, bool with_score) const;
  std::size_t blocks() const;

  const Sample& sample_;
  int threads_, node_count_;
  double events_ = 0;
  std::vector<Place> places_;
  std::vector<EventNodes> nodes_;
  std::vector<KeptFraction> kept_;
};

}  // namespace rheocyte
