// What the shapes of a recording's cells say, as columns of its summary.
#pragma once
#include "extract/shape_verdict.h"
#include "report/column.h"

namespace rheocyte {

/// Moduli, elongation and tension by the table of elongated cells.
Columns<ShapeVerdict> elongation_summary_columns();

/// Whether the shapes are those of the model, and whether they still change along the channel.
Columns<ShapeVerdict> verdict_columns();

/// How the cells lie to the axis of the channel.
Columns<BesideAxis> beside_axis_columns();

}  // namespace rheocyte
