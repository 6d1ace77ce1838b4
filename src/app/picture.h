// The picture of a result, drawn by the Python package (python/rheocyte/picture.py).
#pragma once
#include <filesystem>
#include <string>

namespace rheocyte {

/// Draws picture.png and picture.svg from the files in the folder, and of a result in time also time.png, time.svg and
/// the animation time.gif (python/rheocyte/time_picture.py). Returns the reason if it fails, else an empty text.
/// The environment's RHEOCYTE_PYTHON replaces the folder in which the Python package is looked for.
std::string draw_picture(const std::filesystem::path& folder);

/// Draws lines, coverage and error of a finished table. Empty, or why it failed.
std::string draw_table_pictures(const std::filesystem::path& folder);

}  // namespace rheocyte
