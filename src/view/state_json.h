// A state for the page: numbers, outlines and fields, all about the centroid of its outline along the channel.
#pragma once
#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "result/result.h"
#include "serve/http.h"

namespace rheocyte {

class ShownState {
 public:
  explicit ShownState(Result);

  /// result.json's keys, with what `outlines` gives and "hull".
  nlohmann::ordered_json numbers() const;

  /// "contour", closed, in the plane of the fields, and in a duct "contours" from the cameras of its symmetry. Of a
  /// cell off the axis the contour is that in the plane of its offset, about the axis.
  nlohmann::ordered_json outlines() const;

  /// "fields": values at about so many points of straight triangles, as base64. One line; empty without a state.
  std::string fields(int points = usual_points) const;

  /// The same fields without base64: one line that gives the arrays' names, types and counts, then their numbers one
  /// array after another, little endian. Nothing without a state.
  void give_fields(const TakePiece&) const;

 private:
  static constexpr int usual_points = 6000;
  struct Fields;
  bool has_fields() const;
  bool is_off_axis() const { return result_.state.offset_outline.rows() > 0; }

  Result result_;
  double um_;                 ///< of the unit of length
  Eigen::MatrixX2d outline_;  ///< without rows if there is no state
  double origin_ = 0;
};

}  // namespace rheocyte
