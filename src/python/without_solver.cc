// What stands for the solver in a module that was built without it (RHEOCYTE_SOLVER=OFF).
#include "case/user_error.h"
#include "python/bindings.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

void refuse(py::module_& module, const char* name, const char* what) {
  module.def(name, [what](const py::args&, const py::kwargs&) {
    throw UserError(std::string(what) +
                    " needs the solver, without which this rheocyte was built; install the whole package.");
  });
}

}  // namespace

const Binding bind_states([](py::module_& module) { refuse(module, "Session", "solve"); });
const Binding bind_evolution([](py::module_& module) { refuse(module, "Evolution", "evolve"); });
const Binding bind_table_computation([](py::module_& module) { refuse(module, "compute_table", "table"); });

}  // namespace rheocyte
