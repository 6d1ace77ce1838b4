#include "serve/router.h"

#include <algorithm>
#include <new>
#include <nlohmann/json.hpp>

#include "case/key_value.h"
#include "case/split.h"
#include "case/user_error.h"
#include "store/system_limit.h"

namespace rheocyte {

namespace {

bool is_placeholder(std::string_view part) { return part.size() > 2 && part.front() == '{' && part.back() == '}'; }

bool fits(const std::vector<std::string>& pattern, const std::vector<std::string>& path) {
  return std::ranges::equal(pattern, path, [](const std::string& wanted, const std::string& part) {
    return wanted == part || (is_placeholder(wanted) && !part.empty());
  });
}

}  // namespace

void Router::add(std::string_view method, std::string_view pattern, Handler handler, std::size_t body_limit) {
  routes_.push_back({std::string(method), split(pattern, '/'), std::move(handler), body_limit});
}

const Router::Route* Router::find(std::string_view method, std::string_view path, Request::Names* parts) const {
  const std::vector<std::string> asked = split(path, '/');
  const auto found =
      std::ranges::find_if(routes_, [&](const Route& r) { return r.method == method && fits(r.pattern, asked); });
  if (found == routes_.end()) return nullptr;
  for (std::size_t i = 0; parts && i < asked.size(); ++i)
    if (const std::string& name = found->pattern[i]; is_placeholder(name))
      (*parts)[name.substr(1, name.size() - 2)] = asked[i];
  return &*found;
}

bool Router::knows(std::string_view path) const {
  const std::vector<std::string> asked = split(path, '/');
  return std::ranges::any_of(routes_, [&](const Route& r) { return fits(r.pattern, asked); });
}

std::optional<std::size_t> Router::body_limit(std::string_view method, std::string_view path) const {
  const Route* route = find(method, path, nullptr);
  return route ? std::optional(method == "GET" ? 0 : route->body_limit) : std::nullopt;
}

Answer Router::answer(Request request) const {
  const Route* route = find(request.method, request.path, &request.parts);
  if (!route && knows(request.path)) return refusal(405, "method", "This path does not answer to such a request.");
  if (!route) return refusal(404, "unknown", "There is no such path.");
  try {
    return route->handler(request);
  } catch (const Refused& refused) {
    return refusal(refused.status, refused.reason, refused.what());
  } catch (const KeyError& error) {
    return json_answer({{"error", error.what()}, {"reason", "case"}, {"key", error.key}}, 400);
  } catch (const SystemLimit& limit) {
    return refusal(503, "limit", limit.what());
  } catch (const UserError& error) {
    return refusal(400, "input", words_ ? words_(error.what()) : error.what());
  } catch (const std::bad_alloc&) {
    return refusal(503, "limit", memory_does_not_suffice);
  } catch (const std::exception& error) {
    return refusal(500, "bug", std::string("An error of the program itself, please report it: ") + error.what());
  }
}

}  // namespace rheocyte
