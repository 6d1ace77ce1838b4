// The settings of each command that reads recordings, declared once. A new one needs its member in events/options.h,
// its declaration in events/recording_settings.cc, and the code that uses it; the rest follows
// (`python -m rheocyte.recordings_stub` makes the type stub again).
#pragma once
#include "events/options.h"
#include "events/setting.h"

namespace rheocyte {

/// Their values go into these options, which must outlive them. In the order in which they are listed.
Settings settings_of(ExtractOptions&);
Settings settings_of(ModuliOptions&);
Settings settings_of(TimeCourseOptions&);
Settings settings_of(PopulationOptions&);
Settings settings_of(FeaturesOptions&);
/// How recordings were measured, and which events count.
Settings settings_of(MeasuringOptions&);

/// Of the look-up table of one modulus: an identifier, or where it is; and for which section it is.
Settings table_settings(std::string& table, std::optional<Section>& section);

}  // namespace rheocyte
