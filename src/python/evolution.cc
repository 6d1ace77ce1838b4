// A cell on its way in time, state by state.
#include <pybind11/stl.h>

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>

#include "case/scales.h"
#include "case/user_error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "python/result_object.h"
#include "result/judge_end.h"
#include "result/result_in_time.h"
#include "store/thread.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

py::array_t<double> rows_of(const Eigen::MatrixX2d& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.rows()), py::ssize_t{2}});
  auto rows = array.mutable_unchecked<2>();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (int c = 0; c < 2; ++c) rows(i, c) = points(i, c);
  return array;
}

/// What is told of a time of output.
struct SeenFrame {
  ContourFrame contour;
  StateNumbers numbers;
};

/// Computes in a thread of its own; frames wait until they are asked for.
class Evolution {
 public:
  explicit Evolution(const Case& c) : result_{c, scales_of(c), problem_of(c), {}} {
    if (c.time.scheme == TimeScheme::stationary)
      throw UserError(
          "rheocyte.evolve: the case has neither time.end_us nor time.end_um; give one, and cell.viscosity_mPas.");
    thread_ = Thread([this](const std::stop_token&) { follow(); });
  }
  ~Evolution() {
    stop_ = true;
    const py::gil_scoped_release released;
    thread_.join();
  }
  Evolution(const Evolution&) = delete;
  Evolution& operator=(const Evolution&) = delete;

  /// The next frame as a dictionary, None at the end. Ctrl-C ends the computation; what was computed stays.
  py::object next() {
    const auto interruption = wait_or_interrupt([this](auto duration) {
      std::unique_lock lock(mutex_);
      return changed_.wait_for(lock, duration, [this] { return is_over_ || !frames_.empty(); });
    });
    if (interruption) {
      stop_ = true;
      throw *interruption;
    }
    std::unique_lock lock(mutex_);
    if (frames_.empty() && failure_) std::rethrow_exception(failure_);
    if (frames_.empty()) return py::none();
    const SeenFrame frame = std::move(frames_.front());
    frames_.pop_front();
    lock.unlock();
    return described(frame);
  }

  /// Columns of history.csv for the steps so far.
  py::dict history() {
    const std::scoped_lock lock(mutex_);
    py::dict columns;
    const auto add = [&](std::string_view name, const auto& value) {
      std::vector<double> values;
      for (const HistoryRow& row : record_.rows) values.push_back(value(row));
      columns[py::str(name)] = array_of(std::move(values));
    };
    add("t_us", [](const HistoryRow& row) { return row.t_us; });
    for (std::size_t k = 0; k < history_measures.size(); ++k)
      add(history_measures[k].name, [k](const HistoryRow& row) { return row.measures[k]; });
    for (const auto& field : history_fields()) add(field.name, field.value);
    return columns;
  }

  bool is_over() {
    const std::scoped_lock lock(mutex_);
    return is_over_;
  }
  void stop() { stop_ = true; }
  /// Of the last state, once it is over.
  Result result() const { return result_; }

 private:
  void follow() {
    try {
      const TimeObserver observer{[this](const TimeFrame& frame) { add(frame); },
                                  [this](const TimePoint& point, const TimeState&) { add(point); }};
      result_.state =
          follow_in_time(result_.problem, time_run_of(result_.input, result_.scales), observer, nullptr, &stop_);
      judge_end(result_, record_, stop_);
      refuse_unfinite_numbers(result_);
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
  }

  void add(const TimeFrame& frame) {
    SeenFrame seen{contour_frame(frame, result_.scales), frame.state};
    const std::scoped_lock lock(mutex_);
    frames_.push_back(std::move(seen));
    changed_.notify_all();
  }

  void add(const TimePoint& point) {
    const std::scoped_lock lock(mutex_);
    record_.rows.push_back(history_row(point, result_.scales));
  }

  py::dict described(const SeenFrame& frame) const {
    py::dict d;
    d["t_us"] = frame.contour.t_us;
    d["contour"] = rows_of(frame.contour.point_um);
    d["position_um"] = frame.contour.position_um;
    for (const auto& measure : state_measures)
      d[py::str(measure.name)] = measure.physical(frame.numbers, result_.scales);
    return d;
  }

  Result result_;
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<SeenFrame> frames_;
  TimeRecord record_;  ///< its rows alone
  bool is_over_ = false;
  std::exception_ptr failure_;
  Thread thread_;
};

}  // namespace

void bind_evolution(py::module_& module) {
  py::class_<Evolution>(module, "Evolution")
      .def(py::init<const Case&>())
      .def("next", &Evolution::next)
      .def("history", &Evolution::history)
      .def("is_over", &Evolution::is_over)
      .def("stop", &Evolution::stop)
      .def("result", &Evolution::result);
}

}  // namespace rheocyte
