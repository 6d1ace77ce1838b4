// Viscosity of the buffers of measurements.
#pragma once
#include <span>

#include "measurement/viscosity.h"

namespace rheocyte {

/// As Buffer::viscosity; NaN at temperatures that no buffer in a channel has.
void viscosities_at(const Buffer& buffer, const ChannelFlow& flow, std::span<const double> celsius,
                    std::span<double> mPas);

}  // namespace rheocyte
