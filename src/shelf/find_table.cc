#include "shelf/find_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>
#include <vector>

#include "case/joined.h"
#include "case/nearest_name.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "infer/published_map.h"
#include "shelf/shipped_tables.h"
#include "store/environment.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// Below lib/pythonX.Y of a prefix, or on Windows below Lib.
void add_packages_of(const fs::path& prefix, std::vector<fs::path>& folders) {
  if (prefix.empty()) return;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(prefix / "lib", error)) {
    const std::string name = entry.path().filename().string();
    if (name == "site-packages") folders.push_back(entry.path());
    if (!name.starts_with("python3")) continue;
    for (const char* const kind : {"site-packages", "dist-packages"}) folders.push_back(entry.path() / kind);
  }
}

// Of the python3 that a shell would start: its environment, and that in which a link to it leads.
void add_packages_of_python(std::vector<fs::path>& folders) {
  const fs::path program = program_in_path(python_name);
  if (program.empty()) return;
  std::error_code error;
  for (const fs::path& place : {program, fs::canonical(program, error)})
    add_packages_of(prefix_of_program(place), folders);
}

std::vector<fs::path> package_folders() {
  std::vector<fs::path> folders = folders_in("PYTHONPATH");
  add_packages_of(to_path(environment("VIRTUAL_ENV")), folders);
  add_packages_of(to_path(environment("CONDA_PREFIX")), folders);
  add_packages_of_python(folders);
  if (const fs::path home = to_path(environment("HOME")); !home.empty()) add_packages_of(home / ".local", folders);
  add_packages_of("/usr/local", folders);
  add_packages_of("/usr", folders);
  return folders;
}

std::map<std::string, fs::path> installed_tables() {
  std::map<std::string, fs::path> tables;
  for (const auto& folder : package_folders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / "dclab/features/emodulus", error)) {
      if (entry.path().extension() != ".txt") continue;
      const auto identifier = published_identifier(entry.path());
      if (!identifier.empty()) tables.try_emplace(identifier, entry.path());
    }
  }
  return tables;
}

}  // namespace

fs::path find_table(const std::string& wanted, const std::string& asked_by, const fs::path& folder) {
  std::error_code error;
  if (fs::path file = to_path(wanted); fs::exists(file, error)) return file;
  auto tables = shipped_tables(folder);
  tables.merge(installed_tables());
  if (const auto found = tables.find(wanted); found != tables.end()) return found->second;
  const auto names = names_in(tables);
  const std::string place = fmt::format("rheocyte: {} {}: there is no such file or table{}", asked_by,
                                        one_line(wanted, 200), did_you_mean(wanted, names));
  const bool has_published =
      std::ranges::any_of(tables, [](const auto& table) { return table.second.extension() == ".txt"; });
  const std::string published =
      has_published
          ? ""
          : " Published tables such as LE-2D-FEM-19 come with dclab (pip install dclab), which was searched for in "
            "PYTHONPATH, VIRTUAL_ENV, CONDA_PREFIX, next to the python3 of the PATH, in ~/.local, /usr/local and /usr.";
  throw UserError(names.empty() ? place + ". Give the path of a table." + published
                                : fmt::format("{} (there are {}).{}", place, joined(names, ", "), published));
}

}  // namespace rheocyte
