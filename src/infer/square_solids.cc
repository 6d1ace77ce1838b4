#include "infer/square_solids.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "infer/shape_map.h"

namespace rheocyte {

SquareSolids::SquareSolids(const ModulusMap& square, const ChannelFlow& flow)
    : square_(square), to_square_(scale_factors(flow, square.origin().flow)) {
  assert(square.origin().section == Section::square && square.shapes());
}

double SquareSolids::held_area(double area_um2) const {
  const auto areas = square_.areas();
  return std::clamp(area_um2 * to_square_.area, areas.lower, areas.upper);
}

template <class Quantity>
double SquareSolids::deformation_where(double area_um2, double value, const Quantity& quantity) const {
  const auto range = square_.deformations(held_area(area_um2));
  double low = std::log(range.lower), high = std::log(range.upper);
  constexpr int halvings = 40;  // of ten: to 1e-11
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (quantity(std::exp(middle)) < value ? low : high) = middle;
  }
  return std::exp((low + high) / 2);
}

double SquareSolids::deformation_by_mode_3(double area_um2, double mode_3) const {
  const ShapeGrid& shapes = square_.shapes()->shapes();
  const double log_area = std::log(held_area(area_um2));
  return deformation_where(area_um2, mode_3, [&](double d) { return std::abs(shapes.mode(3, log_area, d)); });
}

double SquareSolids::deformation_by_modulus(double area_um2, double modulus_kPa) const {
  return deformation_where(area_um2, 1 / modulus_kPa, [&](double d) { return 1 / this->modulus_kPa(area_um2, d); });
}

double SquareSolids::modulus_kPa(double area_um2, double deformation) const {
  const double area = held_area(area_um2);
  const auto range = square_.deformations(area);
  return square_.modulus_kPa(area, std::clamp(deformation, range.lower, range.upper)) / to_square_.modulus;
}

ShapeVector SquareSolids::shape(double area_um2, double deformation) const {
  const ShapeGrid& shapes = square_.shapes()->shapes();
  const double log_area = std::log(held_area(area_um2));
  ShapeVector shape = ShapeVector::Zero();
  shape(int(ShapeFeature::area_um2)) = std::log(area_um2);
  shape(int(ShapeFeature::deformation)) = deformation;
  shape(int(ShapeFeature::moment_ratio)) = std::pow(shapes.inertia_ratio(log_area, deformation), -2);
  for (int k = first_radius_mode; k <= last_radius_mode; ++k)
    shape(int(ShapeFeature::first_mode) + k - min_mode) = shapes.mode(k, log_area, deformation);
  return shape;
}

}  // namespace rheocyte
