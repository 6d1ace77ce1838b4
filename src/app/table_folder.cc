#include "app/table_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "app/build_info.h"
#include "app/whole_file.h"
#include "case/user_error.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr const char* work = "branches";
constexpr const char* mark = "begun-by.txt";

std::string reason_of(int number) { return std::generic_category().message(number); }

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", path.string(), reason));
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What an interrupted write leaves: name.PROCESS.tmp. Other files of that kind are not ours.
bool is_unfinished(const fs::path& path) {
  const std::string process = path.stem().extension().string();
  return path.extension() == ".tmp" && process.size() > 1 &&
         process.find_first_not_of("0123456789", 1) == std::string::npos;
}

void write_whole(const fs::path& path, std::string_view content) {
  const fs::path scratch = path.string() + fmt::format(".{}.tmp", ::getpid());
  std::error_code ignored;
  fs::remove(scratch, ignored);  // of an earlier process of this number
  if (const int failed = write_whole_file(scratch, path, content))
    refuse(path, fmt::format("cannot be written ({}); what is finished is kept, start again with the same command.",
                             reason_of(failed)));
}

}  // namespace

Claim::~Claim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

TableFolder::TableFolder(const fs::path& folder, const TableSpec& spec)
    : folder_(folder), spec_(spec), hash_(spec_hash(spec)), places_(sweep_places(spec)) {
  begin();
}

void TableFolder::begin() const {
  const std::string wanted = fmt::format("rheocyte {} table, spec {}\n", version, hash_);
  std::error_code error;
  if (fs::exists(folder_ / mark, error)) {
    const std::string found = content_of(folder_ / mark);
    if (found == wanted) return;
    refuse(folder_,
           fmt::format("holds a table that was begun as \"{}\", not as \"{}\"; give another folder with -o, or "
                       "the spec and program of the first start.",
                       found.substr(0, found.find('\n')), wanted.substr(0, wanted.size() - 1)));
  }
  if (fs::exists(folder_, error) && (!fs::is_directory(folder_, error) || !fs::is_empty(folder_, error)))
    refuse(folder_, "holds other files; give a new or empty folder with -o.");
  fs::create_directories(folder_ / work, error);
  if (error) refuse(folder_, fmt::format("cannot be made ({}).", error.message()));
  write_whole(folder_ / "spec.toml", to_toml(spec_));
  write_whole(folder_ / mark, wanted);
}

fs::path TableFolder::record(int i, bool held) const {
  return folder_ / work /
         fmt::format("{}-{:04}{}.cbor", spec_.is_combined() ? "branch" : "radius", i, held ? "-held" : "");
}

bool TableFolder::has(int i, bool held) const {
  std::error_code error;
  return fs::exists(record(i, held), error);
}

bool TableFolder::is_done(int i) const { return has(i, false) && (!wants_held() || has(i, true)); }

int TableFolder::done() const {
  int count = 0;
  for (int i = 0; i < branches(); ++i) count += is_done(i);
  return count;
}

Claim TableFolder::claim(int i) const {
  const fs::path path = folder_ / work / fmt::format("branch-{:04}.claim", i);
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse(path, fmt::format("cannot be made ({}).", reason_of(errno)));
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Claim(descriptor);
  ::close(descriptor);
  return {};
}

void TableFolder::keep(int i, const SampledBranch& branch, bool held) const {
  write_whole(record(i, held), to_bytes(branch, hash_));
}

SampledBranch TableFolder::read(int i, bool held) const {
  return branch_from_bytes(content_of(record(i, held)), hash_, record(i, held).string());
}

std::vector<SampledBranch> TableFolder::read_all() const {
  std::vector<SampledBranch> all;
  for (int i = 0; i < branches(); ++i) {
    all.push_back(read(i, false));
    if (wants_held()) all.push_back(read(i, true));
  }
  return all;
}

void TableFolder::tidy() const {
  std::error_code error;
  for (const auto& place : {folder_ / work, folder_})
    for (const auto& entry : fs::directory_iterator(place, error))
      if (entry.path().extension() == ".claim" || is_unfinished(entry.path())) fs::remove(entry.path(), error);
}

void TableFolder::publish(const std::string& name, std::string_view content) const {
  write_whole(folder_ / name, content);
}

}  // namespace rheocyte
