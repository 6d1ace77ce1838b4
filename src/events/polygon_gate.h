// A polygon in the plane of two features, within which events are taken.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/event_features.h"

namespace rheocyte {

class PolygonGate {
 public:
  struct Corner {
    double x, y;  ///< along the axes
  };
  /// Straight edges in the plane of two features; inverted: events outside are taken, also those without a number.
  struct Shape {
    std::string x, y;
    std::vector<Corner> corners;
    bool is_inverted = false;
  };

  /// "FEATURE,FEATURE=X,Y:X,Y:X,Y" with at least three corners; the edges are straight over the logarithm of a feature
  /// whose name stands behind "log:". UserError otherwise.
  explicit PolygonGate(const std::string& text);
  explicit PolygonGate(Shape shape);

  /// "area_um,deform in a polygon of 4 corners"
  std::string description() const;
  /// The same with all corners.
  std::string description_in_full() const;
  /// UserError naming a feature that the recording does not have.
  void check(const EventFeatures& features) const;
  /// Takes those of the events [first, first + inside.size()) out that are not within (or outside, if it is inverted);
  /// those without a number are never within.
  void apply(EventFeatures& features, std::size_t first, std::vector<char>& inside) const;
  /// Whether the place lies within, by the number of edges to the right (even-odd); the lower end of an edge belongs to
  /// it, the upper one does not.
  bool holds(double x, double y) const;
  /// Whether one of its features is such a one.
  bool is_over(bool (*is_such)(std::string_view feature)) const;
  struct Range {
    std::string feature;
    double min, max;
  };
  /// Of the corners, along the one feature that is none such; nothing if both are, or if events outside are taken.
  std::optional<Range> range_of_other(bool (*is_such)(std::string_view feature)) const;
  /// Its corners as values of two features, with more of them along edges that are curved there; empty if it is one of
  /// other features.
  std::vector<Corner> outline_over(std::string_view x, std::string_view y) const;

 private:
  struct Axis {
    std::string feature;
    bool is_log = false;
    double place(double value) const;
    double value(double place) const;
  };
  static Axis axis_of(const std::string& name);

  Axis x_, y_;
  std::vector<Corner> corners_;
  bool is_inverted_ = false;
};

}  // namespace rheocyte
