// Stationary states: one, and a session of many.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <mutex>
#include <nlohmann/json.hpp>

#include "case/scales.h"
#include "case/user_error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/result_object.h"
#include "solve/session.h"

namespace rheocyte {

namespace py = pybind11;

std::string json_text(const Result& result) {
  return to_json(result).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

py::dict surface_columns(const Result& result) {
  const SurfaceProfile& surface = result.state.surface;
  std::vector<Eigen::Index> rows;  // the first point of a piece is the last one of the piece before
  for (Eigen::Index i = 0; i < surface.point.rows(); ++i)
    if (i == 0 || i % SurfaceProfile::points_per_piece != 0) rows.push_back(i);
  py::dict columns;
  for (const auto& field : contour_fields()) {
    std::vector<double> values;
    const double unit = dimensionless_one(unit_of(field.name), result.scales);
    for (const auto i : rows) values.push_back(field.value({surface, i}) * unit);
    columns[py::str(field.name)] = array_of(std::move(values));
  }
  return columns;
}

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
  py::class_<Result>(module, "Result")
      .def("json", [](const Result& r) { return json_text(r); })
      .def("surface", &surface_columns)
      .def("has_state", [](const Result& r) { return bool(r.state.write_fields); })
      .def("write_fields",
           [](const Result& r, const std::string& path) {
             const py::gil_scoped_release released;
             return r.state.write_fields && r.state.write_fields(path, r.scales);
           })
      .def("status", [](const Result& r) { return name(r.state.outcome.status); });
  py::class_<SharedSession>(module, "Session")
      .def(py::init<std::size_t>())
      .def("solve", &SharedSession::solve)
      .def("warm_starts", &SharedSession::warm_starts)
      .def("memory_bytes", &SharedSession::memory_bytes);
}

}  // namespace rheocyte
