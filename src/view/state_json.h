// A state for the page: numbers, outlines and fields, all about the centroid of its outline.
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

  /// result.json's keys, with "contour" and "hull", closed, and in a square channel "contours" from both sides.
  nlohmann::ordered_json numbers() const;

  /// "fields": values at about so many points of straight triangles, as base64. One line; empty without a state.
  std::string fields(int points = usual_points) const;

  /// The same fields without base64: one line that tells the arrays' names, types and counts, then their numbers one
  /// array after another, little endian. Nothing without a state.
  void give_fields(const TakePiece&) const;

 private:
  static constexpr int usual_points = 6000;
  struct Fields;
  bool has_fields() const;

  Result result_;
  double um_;                 ///< of the unit of length
  Eigen::MatrixX2d outline_;  ///< without rows if there is no state
  double origin_ = 0;
};

/// A contour in time likewise, in um.
nlohmann::ordered_json outline_json(const Contour&, double um);

}  // namespace rheocyte
