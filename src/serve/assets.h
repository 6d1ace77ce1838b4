// The files of the page.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "serve/http.h"

namespace rheocyte {

/// What `npm run build` has made in page/dist, read once; nothing on the disk is opened for a request.
class Assets {
 public:
  /// A folder that is not there gives a page that says how to build it.
  explicit Assets(const std::filesystem::path& folder);
  /// Beside the installed program, or in the tree of the sources.
  static std::filesystem::path usual_folder();

  bool empty() const { return files_.empty(); }
  bool has(std::string_view path) const;
  /// The file of a path ("/" is index.html), compressed for those who take that, 304 for those who have it already. The
  /// path must be there, or "/".
  Answer answer(std::string_view path, bool takes_gzip, std::string_view known_tag) const;

 private:
  struct File {
    std::string type, tag, content, compressed;
  };
  std::map<std::string, File, std::less<>> files_;
};

}  // namespace rheocyte
