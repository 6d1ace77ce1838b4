// rheocyte.lib.native
#include "case/user_error.h"
#include "python/bindings.h"
#include "store/build_info.h"

namespace {

namespace py = pybind11;

// The classes of exceptions are Python's own (rheocyte.errors), so that they exist without this module, too.
void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const rheocyte::UserError& error) {
    py::set_error(py::module_::import("rheocyte.errors").attr("UserError"), error.what());
  }
}

}  // namespace

PYBIND11_MODULE(native, module) {
  module.doc() = "The libraries of rheocyte; use the package rheocyte, not this module.";
  module.attr("version") = rheocyte::version;
  py::register_local_exception_translator(&translate);
  rheocyte::bind_cases(module);
  rheocyte::bind_states(module);
  rheocyte::bind_evolution(module);
  rheocyte::bind_tables(module);
  rheocyte::bind_table_computation(module);
  rheocyte::bind_recordings(module);
  rheocyte::bind_analysis(module);
}
