// rheocyte.lib.native
#include <string_view>
#include <utility>

#include "case/user_error.h"
#include "python/bindings.h"
#include "store/build_info.h"

namespace {

namespace py = pybind11;

// The classes of exceptions are Python's own (rheocyte.errors), so that they exist without this module, too.
void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const rheocyte::UserError& error) {
    const std::string_view text = error.what();  // with names of files, which need not be UTF-8
    const auto sentence = py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
    const py::module_ errors = py::module_::import("rheocyte.errors");
    py::set_error(errors.attr("UserError"), errors.attr("in_words_of_python")(sentence));
  }
}

}  // namespace

PYBIND11_MODULE(native, module) {
  module.doc() = "The libraries of rheocyte; use the package rheocyte, not this module.";
  module.attr("version") = rheocyte::version;
  py::register_local_exception_translator(&translate);
  for (const auto bind : rheocyte::Binding::all()) bind(module);
}
