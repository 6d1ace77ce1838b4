// The parts of the module rheocyte.lib.native. What users call stands in python/rheocyte; here numbers and arrays cross
// over, with the interpreter's lock released while they are computed.
#pragma once
#include <pybind11/pybind11.h>

#include <vector>

namespace rheocyte {

/// A part of the module, declared in the file that has its functions: `const Binding binding{[](module_& module)
/// {...}};`
class Binding {
 public:
  using Bind = void (*)(pybind11::module_& module);
  explicit Binding(Bind bind) { all().push_back(bind); }

  /// Of all files that were compiled.
  static std::vector<Bind>& all() {
    static std::vector<Bind> parts;
    return parts;
  }
};

}  // namespace rheocyte
