// Measured time courses of recordings, and virtual recordings.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>

#include "case/to_path.h"
#include "events/isolated_reading.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/objects.h"
#include "python/python_watch.h"
#include "report/time_course_table.h"
#include "shelf/shipped_tables.h"
#include "shelf/virtual_cells.h"
#include "store/atomic_file.h"
#include "store/build_info.h"
#include "synth/virtual_recording.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

// The columns of `rheocyte time-course` by their names, settings, and what is said of the population; a contraction for
// each recording.
py::tuple time_course(const std::vector<std::filesystem::path>& recordings, const std::filesystem::path& place,
                      const std::vector<double>& contraction_um, const TimeCourseOptions& options,
                      const PythonProgress& progress) {
  const MeasuringOptions& measuring = options.measuring;
  check_options(measuring);
  const auto report = interruptible([&](const std::atomic<bool>& stop) -> CourseReport {
    const Watch watch = watched_by(progress, stop);
    const DynamicTable table = read_dynamic_table(dynamic_table_or_shipped(place));
    CourseTable courses(table, options.section);
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      const auto work = [&](const TellProgress& report_progress) {
        return read_course_events(recordings[i], measuring, [&](double fraction) {
          report_progress((double(i) + fraction) / double(recordings.size()));
        });
      };
      courses.add(read_isolated(recordings[i], measuring, watch, work), recordings[i].string(), contraction_um[i]);
    }
    return courses.report(watch);
  });
  return py::make_tuple(table_of(course_columns(), report.rows), report.remarks, report.lines);
}

// The file appears whole or not at all; the caller has looked whether one is there. The number of its events.
std::size_t synth(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
                  const std::filesystem::path& place, const PythonProgress& progress) {
  SynthSpec spec = parse_synth_spec(text, name, settings);
  const RecordingProvenance provenance{std::string("rheocyte ") + version, text};
  return interruptible([&](const std::atomic<bool>& stop) -> std::size_t {
    const Watch watch = watched_by(progress, stop);
    const auto shapes = virtual_cells(spec, to_path(name).parent_path());
    AtomicFile file(place);
    const auto made = write_virtual_recording(spec, *shapes, provenance, file.scratch(), [&](double fraction) {
      watch.progress(fraction);
      watch.go_on();
    });
    file.publish();
    return made.events;
  });
}

}  // namespace

const Binding bind_courses([](py::module_& module) {
  module.def("time_course", &time_course);
  module.def("synth", &synth);
});

}  // namespace rheocyte
