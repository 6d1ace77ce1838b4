// The files of a result.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "result/result.h"
#include "store/result_folder.h"

namespace rheocyte {

using FieldWriter = std::function<bool(const std::string& path, const Scales&)>;

/// Writes a .vtu file and looks whether it is complete. UserError that names the folder that the user wants.
void write_field_file(const FieldWriter&, const Scales&, const std::filesystem::path& file,
                      const std::filesystem::path& wanted_folder);

/// Writes case.toml, contours, fields.vtu and result.json with this content; the folder is not published yet.
/// UserError.
void write_result(const Result&, ResultFolder& folder, const std::filesystem::path& wanted_folder,
                  std::string_view result_json);

}  // namespace rheocyte
