#include "population/likelihood.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "store/tasks.h"

namespace rheocyte {
namespace {

/// Sums are made within blocks of events and then over the blocks in their order, whichever thread has computed them.
constexpr std::size_t events_per_block = 128;

/// work(0) .. work(count - 1), each once.
void in_threads(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  Tasks tasks;
  for (std::size_t k = 0; k < count; ++k) tasks.add(0, [&work, k](int) { work(k); });
  tasks.run(int(std::min(count, std::size_t(std::max(threads, 1)))));
}

}  // namespace

PopulationLikelihood::PopulationLikelihood(const Sample& sample, int threads, int nodes)
    : sample_(sample), threads_(threads), node_count_(nodes), events_(sample.events()) {
  for (const EventGroup& group : sample.groups)
    for (const SampleEvent& event : group.events) places_.push_back({&group, &event});
  std::vector<std::unique_ptr<const KeptFraction>> kept(sample.kept.size());
  in_threads(kept.size(), threads,
             [&](std::size_t k) { kept[k] = std::make_unique<const KeptFraction>(sample.kept[k]); });
  for (const auto& one : kept) kept_.push_back(*one);
}

std::size_t PopulationLikelihood::blocks() const { return (places_.size() + events_per_block - 1) / events_per_block; }

void PopulationLikelihood::place(const CellLaw& law) {
  const std::array added{sample_.added_area_variance, sample_.added_measure_variance};
  std::vector<std::vector<EventNodes>> of_blocks(blocks());
  in_threads(of_blocks.size(), threads_, [&](std::size_t block) {
    const std::size_t first = block * events_per_block, last = std::min(first + events_per_block, places_.size());
    of_blocks[block].reserve(last - first);
    for (std::size_t i = first; i < last; ++i)
      of_blocks[block].emplace_back(*places_[i].group->map, *places_[i].event, law.at(places_[i].group->elongation),
                                    added, node_count_);
  });
  nodes_.clear();
  nodes_.reserve(places_.size());
  for (auto& block : of_blocks) std::ranges::move(block, std::back_inserter(nodes_));
}

PopulationLikelihood::Value PopulationLikelihood::value_of_block(std::size_t block, const CellLaw& law,
                                                                 bool with_score) const {
  Value sum;
  const std::size_t first = block * events_per_block, last = std::min(first + events_per_block, places_.size());
  for (std::size_t i = first; i < last; ++i) {
    const double count = places_[i].event->count, elongation = places_[i].group->elongation;
    const EventAnswer answer = nodes_[i].answer(law.at(elongation), with_score);
    sum.log_likelihood += count * answer.log_likelihood;
    if (!with_score) continue;
    const LawVector score = CellLaw::score(answer.score, elongation);
    sum.score += count * score;
    sum.products.noalias() += count * score * score.transpose();
  }
  return sum;
}

CellDistribution PopulationLikelihood::cells_of(std::size_t kept_class, const CellLaw& law) const {
  return law.at(sample_.kept[kept_class].elongation);
}

PopulationLikelihood::Value PopulationLikelihood::value(const LawVector& q, bool with_score) const {
  const CellLaw law = CellLaw::of(q);
  const std::size_t of_events = blocks();
  std::vector<Value> values(of_events);
  std::vector<KeptFraction::Answer> fractions(kept_.size());
  in_threads(of_events + kept_.size(), threads_, [&](std::size_t k) {
    if (k < kept_.size())
      fractions[k] = kept_[k].answer(cells_of(k, law), with_score);
    else
      values[k - kept_.size()] = value_of_block(k - kept_.size(), law, with_score);
  });
  Value all;
  for (const Value& v : values) {
    all.log_likelihood += v.log_likelihood;
    all.score += v.score;
    all.products += v.products;
  }
  LawVector by_gates = LawVector::Zero();
  for (std::size_t k = 0; k < fractions.size(); ++k) {
    all.log_likelihood -= sample_.kept[k].count * std::log(fractions[k].fraction);
    by_gates += sample_.kept[k].count * CellLaw::score(fractions[k].score, sample_.kept[k].elongation);
  }
  const LawVector each = by_gates / events_;
  all.products += -all.score * each.transpose() - each * all.score.transpose() + events_ * each * each.transpose();
  all.score -= by_gates;
  return all;
}

PopulationLikelihood::Value PopulationLikelihood::at(const LawVector& q) const { return value(q, true); }

LawMatrix PopulationLikelihood::information(const LawVector& q, const LawVector& steps) const {
  LawMatrix information;
  for (int k = 0; k < law_parameters; ++k) {
    LawVector ahead = q, behind = q;
    ahead(k) += steps(k);
    behind(k) -= steps(k);
    information.col(k) = (at(behind).score - at(ahead).score) / (2 * steps(k));
  }
  return (information + information.transpose()) / 2;
}

double PopulationLikelihood::kept_fraction(const CellLaw& law) const {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    sum += sample_.kept[k].count * std::log(kept_[k].answer(cells_of(k, law), false).fraction);
    count += sample_.kept[k].count;
  }
  return count > 0 ? std::exp(sum / count) : 1;
}

PopulationLikelihood::Elongations PopulationLikelihood::elongations(const CellLaw& law) const {
  double count = 0, sum = 0, squares = 0;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const KeptClass& kept = sample_.kept[k];
    const double before = kept.count / kept_[k].answer(cells_of(k, law), false).fraction;
    count += before;
    sum += before * kept.elongation;
    squares += before * (kept.elongation * kept.elongation + kept.elongation_variance);
  }
  if (!(count > 0)) return {};
  const double mean = sum / count;
  return {mean, squares / count - mean * mean};
}

std::vector<ShrunkenCell> PopulationLikelihood::shrunken(const CellLaw& law) const {
  std::vector<ShrunkenCell> all(nodes_.size());
  in_threads(blocks(), threads_, [&](std::size_t block) {
    const std::size_t first = block * events_per_block, last = std::min(first + events_per_block, nodes_.size());
    for (std::size_t i = first; i < last; ++i) all[i] = nodes_[i].shrunken(law.at(places_[i].group->elongation));
  });
  return all;
}

}  // namespace rheocyte
