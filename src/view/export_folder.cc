#include "view/export_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "case/to_path.h"
#include "case/user_error.h"
#include "serve/json_member.h"
#include "store/atomic_file.h"
#include "store/scratch.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_name = 120;

bool is_file_name(std::string_view name) {
  const auto is_odd = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  return !name.empty() && name.size() <= longest_name && name.front() != '.' &&
         to_path(name).filename() == to_path(name) && std::ranges::none_of(name, is_odd);
}

bool is_same_and_unchanged(const FileFacts& a, const FileFacts& b) {
  return a.is_same_as(b) && a.size == b.size && a.content_changed_ns == b.content_changed_ns;
}

[[noreturn]] void refuse_to_write(const fs::path& path, int reason) {
  throw Refused(507, "disk",
                fmt::format("{} cannot be written ({}).", path.string(), std::generic_category().message(reason)));
}

}  // namespace

ExportFolder::ExportFolder(const fs::path& folder) : folder_(fs::absolute(folder.empty() ? "." : folder)) {
  if (folder.empty()) return;  // the current one: whether it can be written to matters for exports alone
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!error) error.assign(check_writable(folder_), std::generic_category());
  if (error)
    throw UserError(
        fmt::format("rheocyte view: nothing can be written into {} ({}); give another folder with --output.",
                    folder.string(), error.message()));
}

ExportPlace ExportFolder::claim(std::string_view name, ExportKind kind) {
  if (!is_file_name(name))
    throw Refused(400, "name",
                  fmt::format("{} is not a name for a file: give one without folders that does not begin "
                              "with a point.",
                              one_line(name, 60)));
  return {*this, (folder_ / to_path(name)).lexically_normal(), kind};
}

void ExportFolder::check(const fs::path& path, ExportKind kind) const {
  const auto now = facts_of(path, Links::look_at);
  if (!now) return;  // nothing stands there
  const auto known = written_.find(path);
  if (known == written_.end() || !is_same_and_unchanged(known->second, *now))
    throw Refused(409, "exists",
                  fmt::format("{} already exists and was not written by this view; give another name.", path.string()));
  if (now->is_folder != (kind == ExportKind::folder))
    throw Refused(409, "exists",
                  fmt::format("{} is a {} of an earlier export; give another name.", path.string(),
                              now->is_folder ? "folder" : "file"));
}

fs::path ExportFolder::write(std::string_view name, std::string_view content) {
  ExportPlace place = claim(name);
  if (const int failed = write_atomically(place.scratch(), content)) refuse_to_write(place.path(), failed);
  place.publish();
  return place.path();
}

ExportPlace::ExportPlace(ExportFolder& folder, fs::path path, ExportKind kind)
    : folder_(folder), path_(std::move(path)), scratch_(scratch_beside(path_)), kind_(kind) {
  const std::scoped_lock lock(folder_.mutex_);
  folder_.check(path_, kind_);
  if (!folder_.under_way_.insert(path_).second)
    throw Refused(409, "exists", fmt::format("{} is being exported already.", path_.string()));
}

ExportPlace::~ExportPlace() {
  std::error_code error;
  fs::remove(scratch_, error);
  const std::scoped_lock lock(folder_.mutex_);
  folder_.under_way_.erase(path_);
}

void ExportPlace::check() const {
  const std::scoped_lock lock(folder_.mutex_);
  folder_.check(path_, kind_);
}

void ExportPlace::publish() {
  check();
  std::error_code error;
  const bool is_new = !fs::exists(fs::symlink_status(path_, error));
  const int failed = publish_file(scratch_, path_, is_new ? Older::keep : Older::replace);
  if (failed == EEXIST) check();
  if (failed) refuse_to_write(path_, failed);
  keep();
}

void ExportPlace::keep() {
  const auto now = facts_of(path_, Links::look_at);
  if (!now) return;
  const std::scoped_lock lock(folder_.mutex_);
  folder_.written_.insert_or_assign(path_, *now);
}

void Exports::add(std::string what, Export write) { exports_.insert_or_assign(std::move(what), std::move(write)); }

void Exports::add_route(Router& router) {
  router.add(
      "POST", "/api/export", [this](const Request& request) { return answer(request); }, big_body_limit);
}

Answer Exports::answer(const Request& request) {
  const nlohmann::ordered_json wish = request.json();
  const auto found = exports_.find(text_member(wish, "what"));
  if (found == exports_.end()) throw Refused(400, "what", "\"what\" names nothing that can be exported.");
  const FewAtOnce::Turn turn = under_way_.begin();
  return json_answer({{"file", found->second(wish, request, folder_).string()}});
}

}  // namespace rheocyte
