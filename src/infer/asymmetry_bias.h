// What a mechanical elongation does to Young's modulus from the asymmetry of the outline (docs/real-cells.md).
#pragma once

namespace rheocyte {

/// By what share of itself the modulus from the asymmetry is too high if the cell is a solid that is drawn out along
/// the flow; 0 without an elongation, NaN of NaN. `elongation`: c_2 less that of the table's cell of this area and c_3.
double too_high_by_asymmetry(double elongation);

}  // namespace rheocyte
