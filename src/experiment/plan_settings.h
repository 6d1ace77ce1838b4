// The settings of `rheocyte plan`, declared once: options of the command and arguments of Python follow. A new one
// needs its member in experiment/plan_options.h, its declaration in experiment/plan_settings.cc, and the code that uses
// it.
#pragma once
#include "events/setting.h"
#include "experiment/plan_options.h"

namespace rheocyte {

/// Their values go into these options, which must outlive them.
Settings settings_of(PlanOptions&);

}  // namespace rheocyte
