// Measured time courses of recordings, and virtual recordings.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>

#include "case/to_path.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/isolated_reading.h"
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
    const DynamicTable table = read_dynamic_table(dynamic_table_or_shipped(place));
    CourseTable courses(table, options.section);
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      const auto work = [&](const TellProgress& report_progress) {
        return read_course_events(recordings[i], measuring, [&](double fraction) {
          report_progress((double(i) + fraction) / double(recordings.size()));
        });
      };
      const auto events = read_isolated(recordings[i], measuring, work, progress, stop);
      if (stop) return {};
      courses.add(events, recordings[i].string(), contraction_um[i]);
    }
    struct Stopped {};
    try {
      return courses.report([&] {
        if (stop) throw Stopped{};
      });
    } catch (const Stopped&) {
      return {};
    }
  });
  py::dict columns;
  for (const auto& column : course_columns()) {
    py::list values;
    for (const CourseRow& row : report.rows) values.append(py::cast(column.value(row)));
    columns[column.name.c_str()] = values;
  }
  return py::make_tuple(columns, report.remarks, report.lines);
}

// The file appears whole or not at all; the caller has looked whether one is there. The number of its events.
std::size_t synth(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
                  const std::filesystem::path& place, const PythonProgress& progress) {
  SynthSpec spec = parse_synth_spec(text, name, settings);
  const RecordingProvenance provenance{std::string("rheocyte ") + version, text};
  struct Stopped {};
  return interruptible([&](const std::atomic<bool>& stop) -> std::size_t {
    const auto shapes = virtual_cells(spec, to_path(name).parent_path());
    AtomicFile file(place);
    try {
      const auto made = write_virtual_recording(spec, *shapes, provenance, file.scratch(), [&](double fraction) {
        tell(progress, fraction);
        if (stop) throw Stopped{};
      });
      file.publish();
      return made.events;
    } catch (const Stopped&) {
      return 0;
    }
  });
}

}  // namespace

const Binding bind_courses([](py::module_& module) {
  module.def("time_course", &time_course);
  module.def("synth", &synth);
});

}  // namespace rheocyte
