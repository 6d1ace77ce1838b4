#include "measurement/written_file.h"

#include <fmt/format.h>

#include "case/refuse_path.h"
#include "store/scratch.h"
#include "store/system_files.h"

namespace rheocyte {

WrittenFile::WrittenFile(const std::filesystem::path& path) : path_(path) {
  prepare_hdf5();
  const Hdf5Handle access(::H5Pcreate(H5P_FILE_ACCESS));
  ::H5Pset_file_locking(access.get(), false, true);
  file_ = Hdf5Handle(::H5Fcreate(path.string().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()));
  check(bool(file_), "the file");
}

WrittenFile::~WrittenFile() { close_flushed(); }

Hdf5Handle WrittenFile::dataset(const std::string& path, hid_t type, hid_t space, hid_t creation, hid_t access) {
  const Hdf5Handle links(::H5Pcreate(H5P_LINK_CREATE));
  ::H5Pset_create_intermediate_group(links.get(), 1);
  Hdf5Handle made(::H5Dcreate2(file_.get(), path.c_str(), type, space, links.get(), creation, access));
  if (!made) return made;
  ::H5Iinc_ref(made.get());
  datasets_.emplace_back(made.get());
  return made;
}

void WrittenFile::check(bool good, const std::string& what) {
  if (good) return;
  leave_open();
  refuse_path(place_of(path_),
              fmt::format("{} cannot be written; is the disk full, or is writing there not allowed?", what));
}

void WrittenFile::close() { check(close_flushed() && bring_to_disk(path_) == 0, "the file"); }

bool WrittenFile::close_flushed() {
  if (!file_) return false;
  if (::H5Fflush(file_.get(), H5F_SCOPE_LOCAL) < 0) {
    leave_open();
    return false;
  }
  datasets_.clear();
  return ::H5Idec_ref(file_.release()) >= 0;
}

void WrittenFile::leave_open() {
  for (Hdf5Handle& dataset : datasets_) dataset.release();
  datasets_.clear();
  file_.release();
}

}  // namespace rheocyte
