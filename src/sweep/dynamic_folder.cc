#include "sweep/dynamic_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "store/build_info.h"
#include "sweep/follow_course.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

std::string record_of(int piece) { return fmt::format("cell-{:05}.cbor", piece); }

WantedWork wanted_work(const DynamicSpec& spec) {
  return {to_toml(spec), fmt::format("rheocyte {} dynamic table, spec {}\n", version, spec_hash(spec)), "", "cells"};
}

}  // namespace

DynamicFolder::DynamicFolder(fs::path folder, DynamicSpec spec)
    : spec_(std::move(spec)),
      hash_(spec_hash(spec_)),
      wanted_(cells_of(spec_)),
      folder_(std::move(folder), wanted_work(spec_)),
      known_(wanted_.size()) {
  for (int i = 0; i < pieces(); ++i)
    if (has(i)) read(i);
}

std::vector<int> DynamicFolder::missing() const {
  const std::lock_guard lock(known_mutex_);
  std::vector<int> missing;
  for (int i = 0; i < pieces(); ++i) {
    if (!known_[std::size_t(i)]) known_[std::size_t(i)] = has(i);
    if (!known_[std::size_t(i)]) missing.push_back(i);
  }
  return missing;
}

Claim DynamicFolder::claim(int piece) const { return folder_.claim(fmt::format("cell-{:05}", piece)); }

bool DynamicFolder::has(int piece) const { return folder_.has(record_of(piece)); }

CellCourse DynamicFolder::read(int piece) const {
  const std::string name = record_of(piece);
  return course_from_bytes(folder_.content(name), hash_, wanted_[std::size_t(piece)], folder_.record(name).string());
}

void DynamicFolder::compute(int piece, const std::atomic<bool>& stop) const {
  const CellCourse course = follow_course(spec_, wanted_[std::size_t(piece)], &stop);
  if (course.status != Status::stopped) folder_.keep(record_of(piece), to_bytes(course, hash_));
}

std::vector<CellCourse> DynamicFolder::courses() const {
  std::vector<CellCourse> courses;
  for (int i = 0; i < pieces(); ++i) courses.push_back(read(i));
  return courses;
}

DynamicTable DynamicFolder::finish(std::vector<CellCourse> courses) const {
  DynamicContent content{spec_, fmt::format("rheocyte {}", version), std::move(courses)};
  folder_.publish(dynamic_file_name(spec_.identifier), to_bytes(content));
  folder_.tidy();
  return DynamicTable(std::move(content));
}

std::vector<CellCourse> failed(const std::vector<CellCourse>& courses) {
  std::vector<CellCourse> failed;
  std::ranges::copy_if(courses, std::back_inserter(failed),
                       [](const CellCourse& course) { return course.status != Status::converged; });
  return failed;
}

}  // namespace rheocyte
