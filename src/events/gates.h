// Which events are taken: those within limits of features and within polygons.
#pragma once
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "events/gate_options.h"
#include "events/polygon_gate.h"
#include "measurement/event_features.h"

namespace rheocyte {

class Gates {
 public:
  /// UserError: no FEATURE=NUMBER, a min above the max, or no polygon.
  explicit Gates(const GateOptions& options);

  bool empty() const { return limits_.empty() && polygons_.empty() && !events_; }
  /// Whether they limit something that the stiffness of a cell decides: its deformation, circularity, inertia ratios or
  /// modulus, by itself or in a polygon.
  bool limit_shapes() const;
  /// The same without these limits; a polygon over one of these and another feature leaves the range of the other.
  Gates without_shapes() const;

  /// "1 <= area_ratio <= 1.05", "12 chosen events"
  std::string description() const;
  /// The same without the limits of some features.
  std::string description_without(std::initializer_list<std::string_view> features) const;
  /// One for each limit and polygon, with the corners of polygons, and a fingerprint of chosen events.
  std::vector<std::string> lines_in_full() const;
  /// Of one feature; infinite without a gate.
  struct Limits {
    double min, max;
  };
  Limits limits_of(std::string_view feature) const;
  /// Those that are polygons over two features, see PolygonGate::outline_over.
  std::vector<std::vector<PolygonGate::Corner>> outlines_over(std::string_view x, std::string_view y) const;

  /// UserError naming a feature that the recording does not have.
  void check(const EventFeatures& features) const;
  /// Whether events [first, first + inside.size()) lie within all limits and polygons; events without a number do not.
  void apply(EventFeatures& features, std::size_t first, std::vector<char>& inside) const;

 private:
  struct Limit {
    std::string feature;
    double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  };
  /// The options that were given, with their verb.
  static std::string_view options_of(const Limit& limit);
  Limit& limit_of(const std::string& feature);
  std::vector<Limit> limits_;
  std::vector<PolygonGate> polygons_;
  std::optional<std::vector<std::size_t>> events_;  ///< ascending
};

}  // namespace rheocyte
