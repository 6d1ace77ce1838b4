// The keys of a spec for `rheocyte synth`.
#pragma once
#include <span>

#include "case/key_reference.h"
#include "synth/synth_spec.h"

namespace rheocyte {

/// In the order in which they are documented.
std::span<const Key<SynthSpec>> synth_keys();

Reference synth_reference();

}  // namespace rheocyte
