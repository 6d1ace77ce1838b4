// Which events are taken: those within limits of features.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "measurement/event_features.h"

namespace rheocyte {

/// Limits as on the command line: "area_ratio=1.05".
struct GateOptions {
  std::vector<std::string> least, greatest;
  std::optional<std::vector<std::size_t>> events = {};  ///< the only ones that are taken, counted from 0
};

class Gates {
 public:
  /// UserError: no FEATURE=NUMBER, or a least value above the greatest.
  explicit Gates(const GateOptions& options);

  bool empty() const { return limits_.empty() && !events_; }
  /// "1 <= area_ratio <= 1.05", "12 chosen events"
  std::string description() const;

  /// UserError naming a feature that the recording does not have.
  void check(const EventFeatures& features, const std::string& recording) const;
  /// Whether events [first, first + inside.size()) lie within all limits; events without a number do not.
  void apply(EventFeatures& features, std::size_t first, std::vector<char>& inside) const;

 private:
  struct Limit {
    std::string feature;
    double least = -std::numeric_limits<double>::infinity(), greatest = std::numeric_limits<double>::infinity();
  };
  Limit& limit_of(const std::string& feature);
  std::vector<Limit> limits_;
  std::optional<std::vector<std::size_t>> events_;  ///< ascending
};

}  // namespace rheocyte
