// Sessions of stationary states.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <mutex>

#include "case/case_line.h"
#include "case/user_error.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "result/gradient.h"
#include "solve/session.h"
#include "sweep/shared_work.h"

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

  /// Threads: at most; 0: all processors.
  Result solve(const Case& c, const std::vector<std::string>& keys, const std::optional<py::function>& progress,
               int threads) {
    if (c.time.scheme != TimeScheme::stationary)
      throw UserError("rheocyte.solve: the case has keys of the section time; follow it with rheocyte.evolve.");
    const auto gradients = asked_line_keys(c, keys, "rheocyte.solve");
    const auto tell = [&](const BranchStep& step) {
      const py::gil_scoped_acquire acquired;
      (*progress)(described(step));
    };
    if (threads == 0) threads = available_processors();
    return interruptible([&](const std::atomic<bool>& stop) {
      const std::scoped_lock alone(mutex_);
      const auto report = progress ? ProgressCallback(tell) : ProgressCallback{};
      return solve_with_gradients(c, gradients, [&](const Problem& problem, std::span<ProblemLine> lines) {
        return session_.solve(problem, report, {&stop, threads}, lines);
      });
    });
  }

  int warm_starts() const { return session_.warm_starts(); }
  std::size_t memory_bytes() const { return session_.memory_bytes(); }

 private:
  Session session_;
  std::mutex mutex_;
};

}  // namespace

const Binding bind_states([](py::module_& module) {
  py::class_<SharedSession>(module, "Session")
      .def(py::init<std::size_t>())
      .def("solve", &SharedSession::solve)
      .def("warm_starts", &SharedSession::warm_starts)
      .def("memory_bytes", &SharedSession::memory_bytes);
});

}  // namespace rheocyte
