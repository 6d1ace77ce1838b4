// Cells: POST /api/state and /api/case/..., and what is exported of them.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "case/case_line.h"
#include "case/json_guard.h"
#include "case/read_case.h"
#include "case/scales.h"
#include "case/split.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "result/gradient.h"
#include "result/write_result.h"
#include "serve/few_at_once.h"
#include "serve/json_member.h"
#include "store/base64.h"
#include "store/stop_signal.h"
#include "view/case_from_json.h"
#include "view/export_folder.h"
#include "view/solver_threads.h"
#include "view/state_json.h"
#include "view/view_part.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

bool exists(const Result& result) { return has_state(result.state.outcome.status); }

/// As much of the compliance as the state may have: the margin falls from 1 about as the compliance grows.
double stable_reach(const StationaryState& state) {
  return state.outcome.reached / std::max(1.0, 1 - state.stability_margin);
}

/// Why there is none, and the nearest case that has one.
Answer no_state(const Result& result) {
  const Outcome& outcome = result.state.outcome;
  Json json{{"error", outcome.message}, {"reason", "no-state"}, {"status", name(outcome.status)}, {"nearest", nullptr}};
  if (outcome.reached > 0) json["nearest"] = to_json(nearest_existing(result.input, stable_reach(result.state)));
  json["last"] = {{"deformation", result.state.shape.deformation}, {"reached", outcome.reached}};
  return json_answer(json, 422);
}

Result stationary(const Case& c) {
  if (c.time.scheme != TimeScheme::stationary)
    throw Refused(400, "time", "The case has a section [time]: ask /api/evolve for its way.");
  return {c, scales_of(c), problem_of(c), {}};
}

/// Refused (409) if a later request of the stream has come, (503) if no one waits any more.
void solve(SolverThreads& threads, const Request& request,
           const std::function<void(Session&, const std::atomic<bool>&)>& work) {
  const JobEnd end = threads.run({request.asked("stream"), request, work});
  if (end == JobEnd::superseded)
    throw Refused(409, "superseded", "A later request of the same stream has replaced this one.");
  if (end == JobEnd::left) throw Refused(503, "left", "The computation was stopped.");
}

/// The numbers are sent at once, the fields when they are sampled.
Answer with_fields_after(const std::shared_ptr<const ShownState>& shown) {
  Answer answer{.type = "application/octet-stream"};
  answer.give_pieces = [shown, numbers = json_line(shown->numbers()) + "\n"](const TakePiece& take) {
    if (take(numbers)) shown->give_fields(take);
  };
  return answer;
}

/// The keys of `gradient`, with commas between them, or "all".
std::vector<std::string_view> asked_gradients(const Case& c, const std::string& wanted) {
  return wanted.empty() ? std::vector<std::string_view>{} : asked_line_keys(c, split(wanted, ','), "gradient");
}

Answer state(SolverThreads& threads, const Request& request) {
  Result result = stationary(case_from_json(request.json(), request.asked("accuracy")));
  const auto gradients = asked_gradients(result.input, request.asked("gradient"));
  solve(threads, request, [&](Session& session, const std::atomic<bool>& stop) {
    result = solve_with_gradients(result.input, gradients, [&](const Problem& problem, std::span<ProblemLine> lines) {
      return session.solve(problem, {}, &stop, lines);
    });
  });
  if (!exists(result)) return no_state(result);
  const auto shown = std::make_shared<const ShownState>(std::move(result));
  if (request.asked("fields") == "after") return with_fields_after(shown);
  Answer answer = json_answer(shown->numbers());
  if (request.asked("fields") == "1") add_member(answer.body, "fields", shown->fields());
  return answer;
}

/// What makes the same numbers elsewhere.
Json case_as_text(const Case& c) {
  const bool in_time = c.time.scheme != TimeScheme::stationary;
  const std::string json = json_text(to_json(c));
  return {{"toml", to_toml(c)},
          {"command", fmt::format("rheocyte solve /dev/stdin -o result <<'END'\n{}END", to_toml(c))},
          {"python", in_time ? fmt::format("import rheocyte\n\ncase = {}\nfor frame in rheocyte.evolve(case):\n"
                                           "    print(frame[\"t_us\"], frame[\"deformation\"])\n",
                                           json)
                             : fmt::format("import rheocyte\n\ncase = {}\nstate = rheocyte.solve(case)\n"
                                           "print(state.deformation)\n",
                                           json)}};
}

Answer read_text(const Request& request) {
  const Json wish = request.json();
  return json_answer({{"case", to_json(parse_case(text_member(wish, "toml"), "case.toml"))}});
}

std::filesystem::path export_case(const Json& wish, const Request&, ExportFolder& folder) {
  return folder.write(text_member(wish, "name", "case.toml"), to_toml(case_from_json(object_member(wish, "case"))));
}

/// The folder that `rheocyte solve` writes; solved from nothing, so that all its digits are the same.
std::filesystem::path export_result(SolverThreads& threads, const Json& wish, const Request& request,
                                    ExportFolder& folder) {
  Result result = stationary(case_from_json(object_member(wish, "case")));
  ExportPlace place = folder.claim(text_member(wish, "name", "result"), ExportKind::folder);
  solve(threads, request,
        [&](Session&, const std::atomic<bool>& stop) { result.state = solve_stationary(result.problem, {}, &stop); });
  refuse_unfinite_numbers(result);
  ResultFolder target(place.path());
  write_result(result, target, place.path(), json_text(to_json(result)) + "\n");
  place.check();
  target.publish();
  place.keep();
  return place.path();
}

std::filesystem::path export_picture(const Json& wish, const Request&, ExportFolder& folder) {
  const std::string name = text_member(wish, "name"), ending = fmt::format(".{}", text_member(wish, "what"));
  if (!name.ends_with(ending)) throw Refused(400, "name", fmt::format("The name must end with {}.", ending));
  std::string bytes;
  if (!decode_base64(text_member(wish, "data"), bytes) || bytes.empty())
    throw Refused(400, "data", "\"data\" must be the picture as base64.");
  return folder.write(name, bytes);
}

void add_cell_routes(const ViewContext& view) {
  constexpr int most = 32;
  const auto under_way =
      std::make_shared<FewAtOnce>(most, "Too many cells are being computed; wait until some are finished.");
  view.router.add("POST", "/api/state", [&threads = view.threads, under_way](const Request& request) {
    const FewAtOnce::Turn turn = under_way->begin();
    return state(threads, request);
  });
  view.router.add("POST", "/api/case/text",
                  [](const Request& request) { return json_answer(case_as_text(case_from_json(request.json()))); });
  view.router.add("POST", "/api/case/read", read_text);
  view.exports.add("case", export_case);
  view.exports.add("result", [&threads = view.threads](const Json& wish, const Request& request, ExportFolder& folder) {
    return export_result(threads, wish, request, folder);
  });
  view.exports.add("svg", export_picture);
  view.exports.add("png", export_picture);
}

}  // namespace

extern const ViewPart cell_routes{add_cell_routes};

}  // namespace rheocyte
