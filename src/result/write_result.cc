#include "result/write_result.h"

#include <fmt/format.h>

#include <fstream>

#include "case/user_error.h"
#include "case/write_case.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

// A stream that was not flushed may not notice a full disk: what is complete ends with the closing tag.
bool is_complete_vtu(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const auto size = stream.tellg();
  std::string end(static_cast<std::size_t>(std::min<std::streamoff>(size < 0 ? 0 : std::streamoff(size), 64)), '\0');
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  return end.find("</VTKFile>") != std::string::npos;
}

}  // namespace

void write_field_file(const FieldWriter& write, const Scales& scales, const fs::path& file,
                      const fs::path& wanted_folder) {
  bool written = false;
  try {
    written = write(file.string(), scales) && is_complete_vtu(file);
  } catch (const std::exception&) {
    // Whatever it says of itself, the user needs the sentence below.
  }
  if (!written)
    throw UserError(fmt::format("{}: cannot write {}, is the disk full? An older result is left as it was.",
                                wanted_folder.string(), file.filename().string()));
}

void write_result(const Result& result, ResultFolder& folder, const fs::path& wanted_folder,
                  std::string_view result_json) {
  folder.write("case.toml", to_toml(result.input));
  folder.write("contour.csv", contour_csv(result.state.surface, result.scales));
  for (const auto& [name, surface] : result.state.views)
    folder.write(fmt::format("contour_{}.csv", name), contour_csv(surface, result.scales));
  if (result.state.offset_outline.rows() > 0)
    folder.write("contour_offset.csv", offset_outline_csv(result.state.offset_outline, result.scales));
  if (result.state.write_fields)  // else stopped or failed before there was any state
    write_field_file(result.state.write_fields, result.scales, folder.scratch() / "fields.vtu", wanted_folder);
  folder.write("result.json", result_json);
}

}  // namespace rheocyte
