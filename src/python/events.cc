// Events of a recording with their moduli.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "events/event_pass.h"
#include "events/isolated_reading.h"
#include "extract/extraction.h"
#include "extract/shape_words.h"
#include "python/bindings.h"
#include "python/gathered_columns.h"
#include "python/interruptible.h"
#include "python/objects.h"
#include "python/python_watch.h"
#include "report/event_columns.h"
#include "report/recommended_columns.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

struct ExtractedEvents {
  GatheredEvents gathered;
  ExtractSummary summary;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.gathered, s.summary);
  }
};

ExtractedEvents extracted(const std::filesystem::path& file, const ExtractOptions& options, const SharedColumns& memory,
                          const TellProgress& report_progress) {
  const ModulusTables tables(options.table, options.section);
  Recording recording(file);
  EventPass pass(recording, report_progress);
  std::optional<GatheredColumns<EventBlock>> events;
  std::vector<std::string> lines;
  ExtractSummary summary = extract_in_passes(recording, options, tables, pass, [&](Extraction& extraction) {
    events.emplace(event_columns(extraction.knowledge()));
    pass.in_blocks(extraction.block(),
                   [&](std::size_t first, std::size_t count) { events->append(extraction.compute(first, count)); });
    lines = extraction.lines();
    return extraction.summary();
  });
  return {{events->events(), events->write(memory), std::move(lines), summary.warnings, summary.settings_hash},
          std::move(summary)};
}

py::tuple extract(const std::filesystem::path& file, const ExtractOptions& options, const PythonProgress& progress) {
  check_options(options);
  const SharedColumns memory;
  const auto work = [&](const TellProgress& report_progress) {
    return extracted(file, options, memory, report_progress);
  };
  const ExtractedEvents events = interruptible([&](const std::atomic<bool>& stop) {
    return read_isolated(file, options.measuring, watched_by(progress, stop), work);
  });
  py::dict said;
  said["shapes"] = shape_lines(events.summary.shapes);
  said["table"] = events.summary.table;
  said["recommended"] = python_of(recommended_json(events.summary));
  return events.gathered.to_python(memory, said);
}

}  // namespace

const Binding bind_events([](py::module_& module) { module.def("extract", &extract); });

}  // namespace rheocyte
