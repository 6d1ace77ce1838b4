// Where elements along the surface of a deformed cell are even (docs/theory.md, "Mesh").
#pragma once
#include <vector>

namespace rheocyte {

/// A point of a line on the surface along which elements are cut, by its place from 0 to 1 on the line.
struct LinePoint {
  double place;
  double angle;      ///< of the undeformed cell along the line, per place
  double stretch;    ///< along the line
  double curvature;  ///< of the deformed line, relative to that of the undeformed cell
};

/// How many elements are requested from the line's beginning to places on it: by the length of the line, by the angle
/// that it turns, and by that of the undeformed cell.
class RequestedElements {
 public:
  /// Of several lines with the same ascending places the one that needs the shortest elements counts at each.
  explicit RequestedElements(const std::vector<std::vector<LinePoint>>& lines);

  /// Places between elements, the first and the last included, moved that part of the way to where elements are even.
  std::vector<double> moved(std::vector<double> breaks, double evenly) const;
  /// How even elements between these places are: 1 over the number of even ones that the most loaded one stands for.
  double evenness(const std::vector<double>& breaks) const;

 private:
  double up_to(double place) const;
  double place_of(double number) const;

  std::vector<double> place_, number_{0};
};

}  // namespace rheocyte
