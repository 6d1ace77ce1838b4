#include "store/own_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

#include "case/refuse_path.h"
#include "store/atomic_file.h"
#include "store/read_file.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

template <class IsOurs>
void check_place(const fs::path& path, const IsOurs& is_ours, std::string_view way_out) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return;
  if (error) refuse_path(path, fmt::format("cannot write there ({}).", error.message()));
  if (fs::is_directory(status)) refuse_path(path, "is a folder; give the name of a file with -o.");
  if (!fs::is_regular_file(status)) refuse_path(path, "is not a regular file; give another name with -o.");
  if (!is_ours()) refuse_path(path, fmt::format("already exists and was not written by rheocyte; {}.", way_out));
}

}  // namespace

bool is_own_file(const fs::path& path, std::string_view mark) {
  std::error_code error;
  return fs::is_regular_file(path, error) && first_bytes(path, mark.size()) == mark;
}

bool is_own_picture(const fs::path& path) {
  constexpr std::size_t head = 2000;  // behind which a PNG has its pixels, an SVG its drawing, a GIF its frames
  constexpr std::array<std::string_view, 3> marks{std::string_view("Software\0rheocyte", 17),
                                                  "<dc:title>rheocyte</dc:title>", "!\xFE\x08rheocyte"};
  const std::string start = first_bytes(path, head).value_or("");
  return std::ranges::any_of(marks, [&](std::string_view mark) { return start.find(mark) != std::string::npos; });
}

void check_replaceable(const fs::path& path, std::string_view mark, Foreign foreign) {
  check_place(
      path, [&] { return foreign == Foreign::replace || is_own_file(path, mark); },
      foreign == Foreign::keep ? "move it away, or name another folder with -o"
                               : "give another name with -o, or --force to replace it");
}

void check_replaceable_picture(const fs::path& path, std::string_view way_out) {
  check_place(
      path, [&] { return is_own_picture(path); }, way_out);
}

void replace_own_file(const fs::path& wanted, std::string_view content, std::string_view mark, Foreign foreign) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(fs::absolute(wanted), error);  // a link stays a link
  if (error) refuse_path(wanted, fmt::format("cannot write there ({}).", error.message()));
  check_replaceable(path, mark, foreign);
  fs::create_directories(path.parent_path(), error);
  if (error) refuse_path(wanted, fmt::format("cannot make its folder ({}).", error.message()));
  if (const int failed = write_atomically(path, content))
    refuse_path(wanted, fmt::format("cannot be written ({}); an older file is left as it was.",
                                    std::generic_category().message(failed)));
}

}  // namespace rheocyte
