// Moduli of the cells that single images show, noise and all: what a population is compared with in pictures.
#pragma once
#include <vector>

#include "population/cell_distribution.h"
#include "population/sample.h"

namespace rheocyte {

/// The cell of a map that has both measured values.
struct ImagedCell {
  double log_radius, height;
  bool is_in_map;  ///< else the one at the rim beside which it lies: the stiffest one, or one of the softest
};
ImagedCell cell_of_image(const ForwardMap& map, const SampleEvent& event);

/// ln E of that cell; NaN if no cell of the map has, as of those that look rounder than a
/// sphere.
double log_modulus_of_image(const ForwardMap& map, const SampleEvent& event);

/// A histogram of ln(E / kPa) over places of equal width.
struct SingleImages {
  double first = 0, step = 0;  ///< where the first place begins, and how wide each is
  std::vector<double> counts = {};
  double without = 0;  ///< events without a modulus there
};
/// Over some standard deviations of the fitted cells and of the error of ln E by one image. With very many events some
/// determine it, which are spread evenly over all.
SingleImages single_images(const Sample& sample, const CellDistribution& cells, double image_error);

}  // namespace rheocyte
