#include "store/private_folder.h"

#include <system_error>

#include "case/refuse_path.h"

namespace rheocyte {

namespace fs = std::filesystem;

Scratch new_private_folder() {
  std::error_code error, ignored;
  const fs::path place = fs::temp_directory_path(error) / "rheocyte-view";
  for (const Scratch& left : left_over_folders(place)) fs::remove_all(left.path, ignored);
  Scratch made = new_scratch_folder(place);
  made.path /= "files";
  if (!made.failed) fs::create_directory(made.path, error);
  if (error || made.failed)
    refuse_path(place.parent_path(),
                "no folder for temporary files can be made there; is the disk full? TMPDIR names "
                "another place.");
  return made;
}

}  // namespace rheocyte
