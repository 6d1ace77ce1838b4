// Moduli with tension of each cell of a recording.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>

#include "extract/moduli_recording.h"
#include "python/bindings.h"
#include "python/contained_reading.h"
#include "python/interruptible.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

// The lines of `rheocyte moduli`, into a file that may be a piece of memory.
std::vector<std::string> moduli(const std::filesystem::path& recording, const std::filesystem::path& target,
                                const ModuliOptions& options, const PythonProgress& progress) {
  check_options(options.measuring);
  return interruptible([&](const std::atomic<bool>& stop) {
    const ModuliTable table(options);
    const auto work = [&](const TellProgress& tell_progress) {
      return moduli_of_recording(recording, target, options, table, tell_progress).warnings;
    };
    return read_contained(recording, options.measuring, work, progress, stop);
  });
}

}  // namespace

void bind_recordings(py::module_& module) { module.def("moduli", &moduli); }

}  // namespace rheocyte
