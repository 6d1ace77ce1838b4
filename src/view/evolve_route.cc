#include "view/evolve_route.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "case/json_guard.h"
#include "case/scales.h"
#include "result/judge_end.h"
#include "result/result_in_time.h"
#include "serve/json_member.h"
#include "store/thread.h"
#include "view/state_json.h"
#include "view/stated_case.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

constexpr int most_at_once = 4;

/// Fields of so many points and so many frames are given at most: some 30 MB in the browser.
constexpr int points_in_frame = 1500;
constexpr double most_frames_with_fields = 300;
/// For a reader who is so many lines behind fields would pile up here.
constexpr std::size_t most_lines_waiting = 16;

/// Every how many frames have fields.
long frames_between_fields(const TimeRun& run) {
  const double frames = (run.outputs_by_place ? run.end_position : run.end) / run.output_every;
  return std::isfinite(frames) ? std::max(1L, std::lround(std::ceil(frames / most_frames_with_fields))) : 1;
}

/// Computes in a thread of its own; lines wait until they are taken.
class Evolution {
 public:
  Evolution(const Case& c, bool wants_fields)
      : result_{c, scales_of(c), problem_of(c), {}}, wants_fields_(wants_fields) {
    thread_ = Thread([this](const std::stop_token&) { follow(); });
  }
  ~Evolution() {
    stop_ = true;
    thread_.join();
  }
  Evolution(const Evolution&) = delete;
  Evolution& operator=(const Evolution&) = delete;

  void supersede() { is_superseded_ = stop_ = true; }

  /// Gives the lines until the end, or until nobody takes them.
  void give(const TakePiece& take, const Client* client) {
    std::unique_lock lock(mutex_);
    for (bool is_last = false; !is_last;) {
      changed_.wait_for(lock, Client::asked_every, [this] { return is_over_ || !lines_.empty(); });
      is_last = is_over_;
      const std::deque<std::string> lines = std::move(lines_);
      lines_.clear();
      lock.unlock();
      for (const std::string& line : lines) is_last |= !take(line);
      is_last |= client && client->has_left();
      lock.lock();
    }
  }

 private:
  void follow() {
    try {
      const TimeObserver observer{[this](const TimeFrame& frame) { add(frame); },
                                  [this](const TimePoint& point, const TimeState&) { add(point); }};
      run_ = time_run_of(result_.input, result_.scales);
      result_.state = follow_in_time(result_.problem, run_, observer, nullptr, &stop_);
      judge_end(result_, record_, stop_);
      refuse_unfinite_numbers(result_);
      add(is_superseded_
              ? Json{{"error", "A later request of the same stream has replaced this one."}, {"reason", "superseded"}}
              : Json{{"result", to_json(result_, record_)}});
    } catch (const std::exception& error) {
      add(Json{{"error", error.what()}, {"reason", "bug"}});
    }
    const std::scoped_lock lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
  }

  void add(const TimeFrame& frame) {
    record_.frames.push_back(contour_frame(frame, result_.scales));
    const ContourFrame& seen = record_.frames.back();
    std::string line =
        json_line({{"time_s", result_.scales.time_s() * frame.time},
                   {"x_um", seen.position_um},
                   {"deformation", frame.state.shape.deformation},
                   {"velocity_m_per_s", result_.scales.velocity_m_per_s * frame.state.cell_velocity},
                   {"progress", std::isfinite(run_.end) ? frame.time / run_.end : frame.position / run_.end_position},
                   {"contour", outline_json(frame.state.contour, result_.scales.length_um())}});
    if (has_fields())
      add_member(line, "fields",
                 ShownState({result_.input, result_.scales, result_.problem, frame.state}).fields(points_in_frame));
    add(std::move(line));
  }

  bool has_fields() {
    const long frame = long(record_.frames.size()) - 1;
    if (!wants_fields_ || frame % frames_between_fields(run_) != 0) return false;
    const std::scoped_lock lock(mutex_);
    return lines_.size() < most_lines_waiting;
  }

  void add(const TimePoint& point) { record_.rows.push_back(history_row(point, result_.scales)); }

  void add(const Json& line) { add(json_line(line)); }

  void add(std::string line) {
    line += '\n';
    const std::scoped_lock lock(mutex_);
    lines_.push_back(std::move(line));
    changed_.notify_all();
  }

  Result result_;
  bool wants_fields_;
  TimeRecord record_;
  TimeRun run_;
  std::atomic<bool> stop_{false}, is_superseded_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> lines_;
  bool is_over_ = false;
  Thread thread_;
};

/// Those that run, by their streams.
class Evolutions {
 public:
  std::shared_ptr<Evolution> begin(const Case& c, const Request& request) {
    const std::string stream = request.asked("stream");
    const std::scoped_lock lock(mutex_);
    std::erase_if(running_, [](const auto& entry) { return entry.second.expired(); });
    for (auto [at, end] = running_.equal_range(stream); at != end && !stream.empty(); ++at)
      if (const auto older = at->second.lock()) older->supersede();
    if (running_.size() >= most_at_once)
      throw Refused(503, "busy", "Several cells are followed in time already; stop one of them, or wait for its end.");
    auto evolution = std::make_shared<Evolution>(c, request.asked("fields") == "1");
    running_.emplace(stream, evolution);
    return evolution;
  }

 private:
  std::mutex mutex_;
  std::multimap<std::string, std::weak_ptr<Evolution>> running_;
};

Answer evolve(Evolutions& evolutions, const Request& request) {
  const Case c = stated_case(request.json());
  if (c.time.scheme == TimeScheme::stationary)
    throw Refused(
        400, "time",
        "The case has neither time.end_us nor time.end_um; give one, and cell.viscosity_mPas, or ask /api/state.");
  Answer answer;
  answer.type = "application/x-ndjson";
  answer.give_pieces = [evolution = evolutions.begin(c, request), client = request.client](const TakePiece& take) {
    evolution->give(take, client);
  };
  return answer;
}

}  // namespace

void add_evolve_route(Router& router) {
  const auto evolutions = std::make_shared<Evolutions>();
  router.add("POST", "/api/evolve", [evolutions](const Request& request) { return evolve(*evolutions, request); });
}

}  // namespace rheocyte
