#include "sweep/dynamic_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <numeric>
#include <system_error>
#include <thread>

#include "case/user_error.h"
#include "store/build_info.h"
#include "store/read_file.h"
#include "store/thread.h"
#include "store/whole_file.h"
#include "sweep/follow_course.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr const char *cells_folder = "cells", *spec_file = "spec.toml";

[[noreturn]] void refuse_folder(const fs::path& path, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", one_line(path.string(), 300), reason));
}

std::string bytes_in(const fs::path& path) {
  constexpr std::size_t enough = std::size_t{64} << 20U;
  return first_bytes(path, enough).value_or("");
}

void keep_whole(const fs::path& path, std::string_view content) {
  if (const int failed = write_whole_file(path, content))
    refuse_folder(path,
                  fmt::format("cannot be written ({}); what is finished is kept, start again with the same command.",
                              std::generic_category().message(failed)));
}

/// With the spec in it.
void make_folder(const fs::path& folder, const std::string& spec) {
  std::error_code error, ignored;
  if (fs::exists(folder / spec_file, ignored)) {
    if (bytes_in(folder / spec_file) == spec) return;
    refuse_folder(folder,
                  "holds a table of another spec, for another contraction, flow or other cells; give a new folder "
                  "with -o.");
  }
  fs::create_directories(folder, error);
  if (error && !fs::exists(folder, ignored))
    refuse_folder(folder, fmt::format("cannot be made ({}).", error.message()));
  if (!fs::is_directory(folder, ignored) || !fs::is_empty(folder, ignored))
    refuse_folder(folder, "holds other files; give a new or empty folder with -o.");
  keep_whole(folder / spec_file, spec);
}

}  // namespace

DynamicFolder::DynamicFolder(fs::path folder, DynamicSpec spec)
    : folder_(std::move(folder)), spec_(std::move(spec)), hash_(spec_hash(spec_)), wanted_(cells_of(spec_)) {
  make_folder(folder_, to_toml(spec_));
  std::error_code error;
  fs::create_directories(folder_ / cells_folder, error);
  if (error) refuse_folder(folder_ / cells_folder, fmt::format("cannot be made ({}).", error.message()));
  claim_ = claim_on(folder_);
  if (!claim_) refuse_folder(folder_, "another process computes this table, or the file system knows no locks.");
  courses_.resize(wanted_.size());
  for (int i = 0; i < cells(); ++i) {
    if (!fs::exists(record(i), error)) continue;
    courses_[std::size_t(i)] =
        course_from_bytes(bytes_in(record(i)), hash_, wanted_[std::size_t(i)], record(i).string());
    ++done_;
  }
}

fs::path DynamicFolder::record(int i) const { return folder_ / cells_folder / fmt::format("cell-{:05}.cbor", i); }

void DynamicFolder::follow(int i, const std::atomic<bool>& stop) {
  CellCourse course = follow_course(spec_, wanted_[std::size_t(i)], &stop);
  if (course.status == Status::stopped) return;
  keep_whole(record(i), to_bytes(course, hash_));
  courses_[std::size_t(i)] = std::move(course);
  ++done_;
}

bool DynamicFolder::compute(int jobs, const std::function<void(int)>& tell, const std::atomic<bool>& stop) {
  std::atomic<int> next = 0, finished = 0;
  std::atomic<bool> ends = false;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work_on = [&](int) {
    try {
      for (int i = next++; i < cells() && !ends; i = next++)
        if (courses_[std::size_t(i)].status == Status::not_started) follow(i, ends);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      ends = true;
    }
    ++finished;
  };
  {
    const std::vector<Thread> threads = start_threads(jobs, work_on);
    while (finished < int(threads.size())) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (stop) ends = true;
      tell(done_);
    }
  }
  if (failure) std::rethrow_exception(failure);
  return done_ == cells();
}

std::vector<CellCourse> DynamicFolder::failed() const {
  std::vector<CellCourse> failed;
  std::ranges::copy_if(courses_, std::back_inserter(failed), [](const CellCourse& course) {
    return course.status != Status::not_started && course.status != Status::converged;
  });
  return failed;
}

DynamicTable DynamicFolder::finish() const {
  DynamicContent content{spec_, fmt::format("rheocyte {}", version), courses_};
  keep_whole(folder_ / dynamic_file_name(spec_.identifier), to_bytes(content));
  return DynamicTable(std::move(content));
}

double DynamicFolder::seconds() const {
  return std::accumulate(courses_.begin(), courses_.end(), 0.0,
                         [](double sum, const CellCourse& course) { return sum + course.seconds; });
}

}  // namespace rheocyte
