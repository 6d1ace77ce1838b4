// What finite pixels add to the deformation of a contour (docs/theory-extract.md, sec. "pixelation").
#pragma once
#include <span>

namespace rheocyte {

/// Excess of the deformation measured through pixel centres over that of the smooth contour, for a hull of `area_um2`
/// in an image with pixels of `pixel_size_um`; subtract it. Derived by the field's programs for 10 to 1250 um^2.
double deformation_by_pixels_at_area(double area_um2, double pixel_size_um);

/// The same for a cell of `volume_um3`.
double deformation_by_pixels_at_volume(double volume_um3, double pixel_size_um);

/// Subtracts the excess at each area from the deformations, both of one length (asserted); a pixel size of zero
/// changes nothing.
void remove_pixelation(std::span<const double> areas_um2, double pixel_size_um, std::span<double> deformations);

}  // namespace rheocyte
