#include "view/view_session.h"

#include <algorithm>
#include <string_view>

#include "case/case_text.h"
#include "case/given_keys.h"
#include "case/json_guard.h"
#include "case/user_error.h"
#include "serve/json_member.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view opening =
    "# A session of rheocyte view; `rheocyte view` with the path of this file opens it again.\n";
constexpr const char* page_key = "page";

/// JSON as a literal string of TOML, which knows no escapes: no apostrophe and nothing beyond ASCII stands in it.
std::string as_literal(const std::string& name, const Json& tree) {
  std::string text = name + " = '''\n";
  for (const char letter : json_text(tree, JsonCharacters::ascii)) {
    if (letter == '\'')
      text += "\\u0027";
    else
      text += letter;
  }
  return text + "\n'''\n";
}

}  // namespace

bool ViewSession::is_session(const std::filesystem::path& file) { return first_bytes(file, opening.size()) == opening; }

void ViewSession::add(SessionPart part) { parts_.push_back(std::move(part)); }

void ViewSession::read(const std::filesystem::path& file) {
  const std::string name = file.string();
  for (const GivenKey& given : given_keys(read_case_text(file), name)) {
    const auto* text = std::get_if<std::string>(&given.value);
    const auto part = std::ranges::find(parts_, given.key, &SessionPart::name);
    if (!text || (given.key != page_key && part == parts_.end()))
      throw UserError(given.where + ": " + one_line(given.key, 60) + " does not belong in a session of rheocyte view.");
    const Json tree = parse_sound_json(*text);
    if (tree.is_null()) throw UserError(given.where + ": the JSON of " + given.key + " is damaged.");
    if (part != parts_.end())
      part->restore(tree);
    else
      page_ = tree;
  }
}

std::string ViewSession::text() const {
  std::string text(opening);
  for (const SessionPart& part : parts_) text += as_literal(part.name, part.kept());
  const std::scoped_lock lock(mutex_);
  return text + as_literal(page_key, page_);
}

void ViewSession::add_routes(Router& router, Exports& exports) {
  router.add("GET", "/api/session", [this](const Request&) {
    const std::scoped_lock lock(mutex_);
    return json_answer({{page_key, page_}});
  });
  router.add("PUT", "/api/session", [this](const Request& request) {
    const Json tree = request.json();
    if (!tree.contains(page_key)) throw Refused(400, "input", "The session needs \"page\".");
    const std::scoped_lock lock(mutex_);
    page_ = tree[page_key];
    return json_answer(Json::object());
  });
  exports.add("session", [this](const Json& wish, const Request&, ExportFolder& folder) {
    return folder.write(text_member(wish, "name", "session.toml"), text());
  });
}

}  // namespace rheocyte
