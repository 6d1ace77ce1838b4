#include "serve/assets.h"

#include <array>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "case/to_path.h"
#include "numeric/fingerprint.h"
#include "store/build_info.h"
#include "store/supplied_folder.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 11> types{
    {{".html", "text/html; charset=utf-8"},
     {".js", "text/javascript; charset=utf-8"},
     {".css", "text/css; charset=utf-8"},
     {".json", "application/json"},
     {".svg", "image/svg+xml"},
     {".png", "image/png"},
     {".ico", "image/x-icon"},
     {".woff2", "font/woff2"},
     {".wasm", "application/wasm"},
     {".map", "application/json"},
     {".txt", "text/plain; charset=utf-8"}}};

constexpr std::string_view page_is_missing =
    "The page of the view is not built; in the folder of the sources, `cd page && npm ci && npm run build` builds it. "
    "The interface under /api works without it.\n";

/// Empty for what no page has.
std::string_view type_of(const fs::path& file) {
  for (const auto& [ending, type] : types)
    if (file.extension() == to_path(ending)) return type;
  return {};
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

fs::path Assets::usual_folder() { return supplied_folder("RHEOCYTE_PAGE", "../share/rheocyte/page", page_folder); }

Assets::Assets(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
    const std::string_view type = type_of(entry.path());
    if (type.empty() || !entry.is_regular_file(error)) continue;
    File file{std::string(type), {}, content_of(entry.path()), {}};
    file.tag.append(1, '"').append(fingerprint(file.content)).append(1, '"');
    fs::path compressed = entry.path();
    compressed += ".gz";
    if (fs::is_regular_file(compressed, error)) file.compressed = content_of(compressed);
    files_.emplace(std::string("/").append(entry.path().lexically_relative(folder).generic_string()), std::move(file));
  }
}

bool Assets::has(std::string_view path) const { return path == "/" || files_.contains(path); }

Answer Assets::answer(std::string_view path, bool takes_gzip, std::string_view known_tag) const {
  const auto found = files_.find(path == "/" ? "/index.html" : path);
  if (found == files_.end())
    return {.status = 503, .type = "text/plain; charset=utf-8", .body = std::string(page_is_missing)};
  const File& file = found->second;
  // Asked for each time, answered with 304: a new version of the program shows its own page at once.
  Answer answer{.type = file.type,
                .headers = {{"ETag", file.tag}, {"Cache-Control", "no-cache"}, {"Vary", "Accept-Encoding"}}};
  if (known_tag == file.tag) {
    answer.status = 304;
    return answer;
  }
  const bool compressed = takes_gzip && !file.compressed.empty();
  if (compressed) answer.headers.emplace_back("Content-Encoding", "gzip");
  answer.body = compressed ? file.compressed : file.content;
  return answer;
}

}  // namespace rheocyte
