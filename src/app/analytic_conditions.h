// Channel and flow for the analytical model, from the command line: where its physical units are.
#pragma once
#include <optional>
#include <string>

#include "analytic/small_deformation.h"
#include "case/case.h"

namespace CLI {
class App;
}

namespace rheocyte {

/// A case without a cell, and which flow is meant.
struct AnalyticConditions {
  Case input;
  bool square_duct = false;

  Duct duct() const { return square_duct ? Duct::square : Duct::tube; }
};

/// Adds the options of square channel and flow, with the standard conditions of RT-DC as defaults; `complete` finishes
/// them.
void declare_conditions(CLI::App&, AnalyticConditions&);

/// Fills in the channel. UserError if width and radius are given, or a square duct of given radius.
void complete(AnalyticConditions&);

/// eta Q / R^3 in kPa: the capillary number times Young's modulus.
double elastic_scale_kPa(const AnalyticConditions&);

/// r0 / R. UserError, naming the option, if the series do not reach so far.
double checked_radius_ratio(const AnalyticConditions&, double radius_um, std::string_view option);

}  // namespace rheocyte
