// POST /api/evolve: a cell on its way in time, line by line.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "case/json_guard.h"
#include "laws/wall_profile.h"
#include "result/evolution.h"
#include "serve/json_member.h"
#include "serve/router.h"
#include "view/case_from_json.h"
#include "view/state_json.h"
#include "view/view_part.h"

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

/// Lines of JSON: one for each frame, and the result.
class EvolutionLines {
 public:
  EvolutionLines(const Case& c, bool wants_fields)
      : wants_fields_(wants_fields),
        evolution_(c, [this](const TimeFrame& frame, const Evolution<std::string>& so_far) {
          return line_of(frame, so_far);
        }) {}

  void supersede() {
    is_superseded_ = true;
    evolution_.stop();
  }

  /// Gives the lines until the end, or until no one takes them.
  void give(const TakePiece& take, const Watch& watch) {
    bool has_left = false;
    evolution_.follow_here([&] {
      has_left = has_left || !give_waiting(take) || watch.stop();
      if (has_left) evolution_.stop();
    });
    if (has_left) return;
    for (;;) {
      evolution_.wait_for(Client::asked_every);
      const bool is_over = evolution_.is_over();
      if (!give_waiting(take)) return;
      if (is_over) static_cast<void>(take(json_line(last()) + "\n"));
      if (is_over || watch.stop()) return;
    }
  }

 private:
  bool give_waiting(const TakePiece& take) {
    return std::ranges::all_of(evolution_.take(), [&](const std::string& line) { return take(line); });
  }

  Json last() const {
    try {
      evolution_.check();
    } catch (const std::exception& error) {
      return {{"error", error.what()}, {"reason", "bug"}};
    }
    if (is_superseded_)
      return {{"error", "A later request of the same stream has replaced this one."}, {"reason", "superseded"}};
    return {{"result", to_json(evolution_.result(), evolution_.record())}};
  }

  std::string line_of(const TimeFrame& frame, const Evolution<std::string>& so_far) const {
    const Result& result = so_far.result();
    const Scales& scales = result.scales;
    const TimeRun& run = so_far.run();
    const ShownState shown({result.input, scales, result.problem, frame.state});
    Json json{{"time_s", scales.time_s() * frame.time},
              {"x_um", so_far.record().frames.back().position_um},
              {"deformation", frame.state.shape.deformation},
              {"velocity_m_per_s", scales.velocity_m_per_s * frame.state.cell_velocity},
              {"progress", std::isfinite(run.end) ? frame.time / run.end : frame.position / run.end_position}};
    if (std::isfinite(frame.state.deformation_across)) json["deformation_across"] = frame.state.deformation_across;
    if (frame.state.offset_outline.rows() > 0) json["offset_um"] = scales.length_um() * frame.state.offset;
    json.update(shown.outlines());
    if (!result.problem.wall.is_straight()) json["wall"] = wall_seen(result, frame);
    std::string line = json_line(json);
    if (has_fields(so_far)) add_member(line, "fields", shown.fields(points_in_frame));
    return line + "\n";
  }

  /// Round the cell, from where it is, as far as there are fields.
  static Json wall_seen(const Result& result, const TimeFrame& frame) {
    constexpr int samples = 120;
    const double half = frame.state.channel_length / 2 + run_out(result.problem.wall);
    WallLine line = wall_line(result.problem, result.scales, frame.position - half, frame.position + half, samples);
    for (double& x_um : line.x_um) x_um -= result.scales.length_um() * frame.position;
    return {{"x_um", line.x_um}, {"r_um", line.distance_um}};
  }

  bool has_fields(const Evolution<std::string>& so_far) const {
    const long frame = long(so_far.record().frames.size()) - 1;
    return wants_fields_ && frame % frames_between_fields(so_far.run()) == 0 && so_far.waiting() < most_lines_waiting;
  }

  bool wants_fields_;
  std::atomic<bool> is_superseded_{false};
  Evolution<std::string> evolution_;
};

/// Those that run, by their streams.
class Evolutions {
 public:
  std::shared_ptr<EvolutionLines> begin(const Case& c, const Request& request) {
    const std::string stream = request.asked("stream");
    const std::scoped_lock lock(mutex_);
    std::erase_if(running_, [](const auto& entry) { return entry.second.expired(); });
    for (auto [at, end] = running_.equal_range(stream); at != end && !stream.empty(); ++at)
      if (const auto older = at->second.lock()) older->supersede();
    if (running_.size() >= most_at_once)
      throw Refused(503, "busy", "Several cells are followed in time already; stop one of them, or wait for its end.");
    auto evolution = std::make_shared<EvolutionLines>(c, request.asked("fields") == "1");
    running_.emplace(stream, evolution);
    return evolution;
  }

 private:
  std::mutex mutex_;
  std::multimap<std::string, std::weak_ptr<EvolutionLines>> running_;
};

Answer evolve(Evolutions& evolutions, const Request& request) {
  const Case c = case_from_json(request.json());
  if (c.time.scheme == TimeScheme::stationary)
    throw Refused(
        400, "time",
        "The case has neither time.end_us nor time.end_um; give one, and cell.viscosity_mPas, or ask /api/state.");
  Answer answer;
  answer.type = "application/x-ndjson";
  answer.give_pieces = [evolution = evolutions.begin(c, request), watch = request.watch()](const TakePiece& take) {
    evolution->give(take, watch);
  };
  return answer;
}

void add_evolve_routes(const ViewContext& view) {
  view.router.add("POST", "/api/evolve", [running = std::make_shared<Evolutions>()](const Request& request) {
    return evolve(*running, request);
  });
}

}  // namespace

extern const ViewPart evolve_routes{add_evolve_routes};

}  // namespace rheocyte
