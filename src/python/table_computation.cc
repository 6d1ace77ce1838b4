// Whole tables that are computed from Python.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <functional>
#include <optional>
#include <string>

#include "extract/tube_table.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "store/build_info.h"
#include "sweep/table_work.h"
#include "table/finish_table.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

// Works on the folder of a table; tells branches that are done and all. Sentences about what could not be made.
std::vector<std::string> compute_table(const std::string& text, const std::string& name,
                                       const std::vector<std::string>& settings, const std::filesystem::path& place,
                                       int jobs, const std::optional<std::function<void(double)>>& progress) {
  const TableSpec spec = parse_table_spec(text, name, settings);
  return interruptible([&](const std::atomic<bool>& stop) -> std::vector<std::string> {
    const TableFolder folder(place, spec);
    provide_tube_table(folder);
    folder.take_over();
    const auto tell = [&](int done) {
      if (!progress) return;
      const py::gil_scoped_acquire acquired;
      (*progress)(static_cast<double>(done) / folder.branches());
    };
    if (!work_on(TableWork(folder), jobs > 0 ? jobs : available_processors(), {tell, {}}, stop)) return {};
    return finish_table(folder, {}, version);
  });
}

}  // namespace

void bind_table_computation(py::module_& module) { module.def("compute_table", &compute_table); }

}  // namespace rheocyte
