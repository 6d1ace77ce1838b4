#include "store/result_files.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "case/refuse_path.h"
#include "store/own_file.h"
#include "store/system_files.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse_unwritten(const fs::path& place, int reason) {
  refuse_path(place, fmt::format("cannot be written ({}); an older result is left as it was.",
                                 std::generic_category().message(reason)));
}

}  // namespace

void write_for(const fs::path& place, const fs::path& scratch, std::string_view content) {
  if (const int failed = write_part(scratch, content)) refuse_unwritten(place, failed);
}

fs::path ResultFiles::add(const fs::path& place, std::function<void()> check) {
  files_.emplace_back(place, std::move(check));
  places_.push_back(place);
  return files_.back().scratch();
}

void ResultFiles::add_text(const fs::path& place, std::string_view content, std::string_view mark) {
  write_for(place, add(place, [place, mark] { check_replaceable(place, mark, Foreign::keep); }), content);
}

void ResultFiles::publish() {
  if (files_.empty()) return;
  for (std::size_t i = 0; i < files_.size(); ++i)
    if (const int failed = bring_to_disk(files_[i].scratch())) refuse_unwritten(places_[i], failed);
  const Claim alone = wait_for_folder(places_.front().parent_path());
  for (const AtomicFile& file : files_) file.check();
  for (AtomicFile& file : files_) file.publish();
}

}  // namespace rheocyte
