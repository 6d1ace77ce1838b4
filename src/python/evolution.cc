// A cell on its way in time, state by state.
#include "result/evolution.h"

#include <pybind11/stl.h>

#include <memory>
#include <vector>

#include "case/user_error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/result_object.h"
#include "sweep/shared_work.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

/// What is reported of a time of output.
struct SeenFrame {
  ContourFrame contour;
  StateNumbers numbers;
};

class PythonEvolution {
 public:
  /// Threads: at most; 0: all processors.
  PythonEvolution(const Case& c, int threads) {
    if (c.time.scheme == TimeScheme::stationary)
      throw UserError(
          "rheocyte.evolve: the case has neither time.end_us nor time.end_um; give one, and cell.viscosity_mPas.");
    const auto seen = [](const TimeFrame& frame, const Evolution<SeenFrame>& so_far) {
      return SeenFrame{so_far.record().frames.back(), frame.state};
    };
    evolution_ = std::make_unique<Evolution<SeenFrame>>(c, seen, threads > 0 ? threads : available_processors());
  }
  ~PythonEvolution() {
    evolution_->stop();
    const py::gil_scoped_release released;
    evolution_.reset();
  }
  PythonEvolution(const PythonEvolution&) = delete;
  PythonEvolution& operator=(const PythonEvolution&) = delete;

  /// The next frame as a dictionary, None at the end. Ctrl-C ends the computation; what was computed stays.
  py::object next() {
    const auto interruption = wait_or_interrupt([this](auto duration) { return evolution_->wait_for(duration); });
    if (interruption) {
      evolution_->stop();
      throw *interruption;
    }
    const auto frames = evolution_->take(1);
    if (!frames.empty()) return described(frames.front());
    evolution_->check();
    return py::none();
  }

  /// Columns of history.csv for the steps so far.
  py::dict history() {
    const std::vector<HistoryRow> rows = evolution_->rows();
    py::dict columns = columns_of(rows, known_measures(rows));
    for (const auto& field : history_fields()) columns[py::str(field.name)] = column(rows, field.value);
    return columns;
  }

  /// Columns of history_errors.csv once all is over; no rows where they are not known.
  py::dict history_errors() {
    const std::vector<HistoryRow> errors = evolution_->row_errors();
    py::dict columns = columns_of(errors, known_measures(evolution_->rows()));
    columns["position_um"] = column(errors, [](const HistoryRow& row) { return row.position_um; });
    return columns;
  }

  bool is_over() const { return evolution_->is_over(); }
  void stop() { evolution_->stop(); }
  /// Of the last state, once it is over.
  Result result() const { return evolution_->result(); }

 private:
  template <class Value>
  static py::object column(const std::vector<HistoryRow>& rows, const Value& value) {
    std::vector<double> values;
    for (const HistoryRow& row : rows) values.push_back(value(row));
    return array_of(std::move(values));
  }

  /// Times and measures.
  static py::dict columns_of(const std::vector<HistoryRow>& rows, const std::vector<std::size_t>& known) {
    py::dict columns;
    columns["t_us"] = column(rows, [](const HistoryRow& row) { return row.t_us; });
    for (const std::size_t k : known)
      columns[py::str(history_measures[k].name)] = column(rows, [k](const HistoryRow& row) { return row.measures[k]; });
    return columns;
  }

  py::dict described(const SeenFrame& frame) const {
    py::dict d;
    d["t_us"] = frame.contour.t_us;
    d["contour"] = array_of_points(frame.contour.point_um);
    py::dict outlines;
    if (frame.contour.across_um.rows() > 0) outlines["across"] = array_of_points(frame.contour.across_um);
    if (frame.contour.offset_um.rows() > 0) outlines["offset"] = array_of_points(frame.contour.offset_um);
    d["outlines"] = outlines;
    d["position_um"] = frame.contour.position_um;
    for (const auto& measure : state_measures)
      d[py::str(measure.name)] = measure.physical(frame.numbers, evolution_->result().scales);
    return d;
  }

  std::unique_ptr<Evolution<SeenFrame>> evolution_;
};

}  // namespace

const Binding bind_evolution([](py::module_& module) {
  py::class_<PythonEvolution>(module, "Evolution")
      .def(py::init<const Case&, int>())
      .def("next", &PythonEvolution::next)
      .def("history", &PythonEvolution::history)
      .def("history_errors", &PythonEvolution::history_errors)
      .def("is_over", &PythonEvolution::is_over)
      .def("stop", &PythonEvolution::stop)
      .def("result", &PythonEvolution::result);
});

}  // namespace rheocyte
