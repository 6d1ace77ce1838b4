// Sessions of stationary states.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <mutex>

#include "case/scales.h"
#include "case/user_error.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "result/result.h"
#include "solve/session.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

py::dict described(const BranchStep& step) {
  py::dict d;
  d["compliance"] = step.compliance;
  d["deformation"] = step.deformation;
  d["newton_iterations"] = step.newton_iterations;
  d["degree"] = step.degree;
  return d;
}

/// A session that threads may share: they wait for each other.
class SharedSession {
 public:
  explicit SharedSession(std::size_t memory_limit_bytes) : session_(memory_limit_bytes) {}

  Result solve(const Case& c, const std::optional<py::function>& progress) {
    if (c.time.scheme != TimeScheme::stationary)
      throw UserError("rheocyte.solve: the case has keys of the section time; follow it with rheocyte.evolve.");
    const auto tell = [&](const BranchStep& step) {
      const py::gil_scoped_acquire acquired;
      (*progress)(described(step));
    };
    return interruptible([&](const std::atomic<bool>& stop) {
      const std::scoped_lock alone(mutex_);
      Result result{c, scales_of(c), problem_of(c), {}};
      result.state = session_.solve(result.problem, progress ? ProgressCallback(tell) : ProgressCallback{}, &stop);
      refuse_unfinite_numbers(result);
      return result;
    });
  }

  int warm_starts() const { return session_.warm_starts(); }
  std::size_t memory_bytes() const { return session_.memory_bytes(); }

 private:
  Session session_;
  std::mutex mutex_;
};

}  // namespace

void bind_states(py::module_& module) {
  py::class_<SharedSession>(module, "Session")
      .def(py::init<std::size_t>())
      .def("solve", &SharedSession::solve)
      .def("warm_starts", &SharedSession::warm_starts)
      .def("memory_bytes", &SharedSession::memory_bytes);
}

}  // namespace rheocyte
