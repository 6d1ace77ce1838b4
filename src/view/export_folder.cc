#include "view/export_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "case/user_error.h"
#include "store/whole_file.h"
#include "view/json_member.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_name = 120;

bool is_file_name(std::string_view name) {
  const auto is_odd = [](unsigned char c) { return c < 0x20 || c == 0x7F || c == '/'; };
  return !name.empty() && name.size() <= longest_name && name.front() != '.' && std::ranges::none_of(name, is_odd);
}

}  // namespace

ExportFolder::ExportFolder(const fs::path& folder) : folder_(fs::absolute(folder.empty() ? "." : folder)) {
  if (folder.empty()) return;  // the current one: whether it can be written to matters for exports alone
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!error && ::access(folder_.c_str(), W_OK | X_OK) != 0) error.assign(errno, std::generic_category());
  if (error)
    throw UserError(
        fmt::format("rheocyte view: nothing can be written into {} ({}); give another folder with --output.",
                    folder.string(), error.message()));
}

fs::path ExportFolder::claim(std::string_view name) {
  if (!is_file_name(name))
    throw Refused(400, "name",
                  fmt::format("{} is no name for a file: give one without folders that does not begin "
                              "with a point.",
                              one_line(name, 60)));
  fs::path path = (folder_ / name).lexically_normal();
  const std::scoped_lock lock(mutex_);
  std::error_code error;
  const bool is_there = fs::symlink_status(path, error).type() != fs::file_type::not_found;
  if (is_there && !written_.contains(path))
    throw Refused(
        409, "exists",
        fmt::format("{} is there already and was not written by this view; give another name.", path.string()));
  written_.insert(path);
  return path;
}

fs::path ExportFolder::write(std::string_view name, std::string_view content) {
  fs::path path = claim(name);
  if (const int failed = write_whole_file(path, content))
    throw Refused(507, "disk",
                  fmt::format("{} cannot be written ({}).", path.string(), std::generic_category().message(failed)));
  return path;
}

void Exports::add(std::string what, Export write) { exports_.insert_or_assign(std::move(what), std::move(write)); }

void Exports::add_route(Router& router) {
  router.add(
      "POST", "/api/export",
      [this](const Request& request) {
        const nlohmann::ordered_json wish = request.json();
        const auto found = exports_.find(text_member(wish, "what"));
        if (found == exports_.end()) throw Refused(400, "what", "\"what\" names nothing that can be exported.");
        return json_answer({{"file", found->second(wish, folder_).string()}});
      },
      picture_body_limit);
}

}  // namespace rheocyte
