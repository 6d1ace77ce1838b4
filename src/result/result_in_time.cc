#include "result/result_in_time.h"

#include <nlohmann/json.hpp>

#include "case/scales.h"

namespace rheocyte {

TimeRun time_run_of(const Case& c, const Scales& scales) {
  const double unit_us = scales.time_us(), unit_um = scales.length_um();
  TimeRun run;
  run.end = c.time.end_us ? *c.time.end_us / unit_us : HUGE_VAL;
  run.end_position = c.time.end_um ? *c.time.end_um / unit_um : HUGE_VAL;
  run.outputs_by_place = c.time.output_every_um.has_value();
  run.output_every = run.outputs_by_place ? *c.time.output_every_um / unit_um : *c.time.output_every_us / unit_us;
  run.accuracy = c.time.accuracy.value_or(run.accuracy);
  run.degree = int(c.time.degree.value_or(0));
  run.mesh_accuracy = c.time.mesh_accuracy.value_or(run.mesh_accuracy);
  run.estimates_error = c.time.scheme == TimeScheme::monolithic;
  run.scheme = c.time.scheme;
  run.step = c.time.step_us.value_or(0) / unit_us;
  run.surface_elements = surface_elements(c);
  return run;
}

nlohmann::ordered_json to_json(const Result& result, const TimeRecord& record) {
  auto numbers = to_json(result);
  numbers["time"] = record.rows.empty() ? nlohmann::ordered_json() : object_of(time_fields(), record);
  return numbers;
}

}  // namespace rheocyte
