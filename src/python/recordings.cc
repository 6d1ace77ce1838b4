// Moduli with tension of each cell of a recording.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>

#include "events/isolated_reading.h"
#include "extract/moduli_recording.h"
#include "python/bindings.h"
#include "python/gathered_columns.h"
#include "python/interruptible.h"
#include "python/python_watch.h"
#include "report/moduli_columns.h"
#include "store/thread.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

class GatheredModuli : public ModuliConsumer {
 public:
  void begin(const Recording&, const std::vector<std::string>& remarks) override { settings = remarks; }
  void take(std::size_t, const ModuliBlock& block) override { events.append(block); }
  void end(const std::vector<std::string>& remarks) override {
    settings.insert(settings.end(), remarks.begin(), remarks.end());
  }

  GatheredColumns<ModuliBlock> events{moduli_columns()};
  std::vector<std::string> settings;
};

py::tuple moduli(const std::filesystem::path& recording, const ModuliOptions& options, const PythonProgress& progress) {
  check_options(options.measuring);
  const SharedColumns memory;
  return interruptible([&](const std::atomic<bool>& stop) {
           const ModuliTables tables(options);
           const auto work = [&](const TellProgress& report_progress) -> GatheredEvents {
             GatheredModuli gathered;
             const auto summary =
                 moduli_of_recording(recording, options, tables, processors(), gathered, report_progress);
             return {gathered.events.events(), gathered.events.write(memory), gathered.settings, summary.warnings,
                     summary.settings_hash};
           };
           return read_isolated(recording, options.measuring, watched_by(progress, stop), work);
         })
      .to_python(memory);
}

}  // namespace

const Binding bind_recordings([](py::module_& module) { module.def("moduli", &moduli); });

}  // namespace rheocyte
