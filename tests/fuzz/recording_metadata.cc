// Any metadata of a recording state how it was measured, or are refused. Each line of the input is one value,
// "section:key=text"; a text that begins with # is stored as the number behind it.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "events/extract_settings.h"
#include "extract/extract_summary.h"
#include "measurement/basin.h"
#include "measurement/recording_file.h"
#include "refused_or_read.h"

namespace {

namespace fs = std::filesystem;

void write_recording(const fs::path& file, std::string_view bytes) {
  rheocyte::RecordingFile recording(file);
  std::istringstream lines{std::string(bytes)};
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.find('=');
    if (equals == std::string::npos) continue;
    const std::string key = line.substr(0, equals), text = line.substr(equals + 1);
    if (text.starts_with('#'))
      recording.add_metadata(key, std::strtod(text.c_str() + 1, nullptr));
    else
      recording.add_metadata(key, text);
  }
  recording.append("deform", std::vector{0.01, 0.02});
  recording.close();
}

void read_metadata(const fs::path& file) {
  const rheocyte::Recording recording(file);
  rheocyte::labels_of(recording.metadata());
  rheocyte::measurement_identifier(recording.metadata());
  const auto settings = rheocyte::extract_settings({}, rheocyte::PixelUse::correct, recording);
  settings.lines();
  settings.medium_text();
  settings.temperature_text();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path file = fs::temp_directory_path() / ("rheocyte-fuzz-" + std::to_string(::getpid()) + ".rtdc");
  rheocyte::test::refused_or_read(data, size, [](std::string_view bytes) {
    write_recording(file, bytes);
    read_metadata(file);
  });
  fs::remove(file);
  return 0;
}
