// The parts of the module rheocyte.lib.native. What users call stands in python/rheocyte; here numbers and arrays cross
// over, with the interpreter's lock released while they are computed.
#pragma once
#include <pybind11/pybind11.h>

namespace rheocyte {

void bind_cases(pybind11::module_& module);
void bind_results(pybind11::module_& module);
void bind_states(pybind11::module_& module);
void bind_evolution(pybind11::module_& module);
void bind_media(pybind11::module_& module);
void bind_tables(pybind11::module_& module);
void bind_table_computation(pybind11::module_& module);
void bind_options(pybind11::module_& module);
void bind_recordings(pybind11::module_& module);
void bind_events(pybind11::module_& module);
void bind_courses(pybind11::module_& module);
void bind_populations(pybind11::module_& module);
void bind_recording_file(pybind11::module_& module);
void bind_masks(pybind11::module_& module);
void bind_analysis(pybind11::module_& module);

}  // namespace rheocyte
