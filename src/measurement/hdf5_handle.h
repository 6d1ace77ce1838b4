// Ownership of HDF5's identifiers.
#pragma once
#include <hdf5.h>

#include <utility>

namespace rheocyte {

/// Owns one identifier of any kind (file, group, dataset, type, ...) and closes it; tests as false if the call that
/// should have given it failed.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  explicit Hdf5Handle(hid_t id) : id_(id) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) ::H5Idec_ref(id_);
  }

  hid_t get() const { return id_; }
  /// Gives the identifier up without closing it.
  hid_t release() { return std::exchange(id_, -1); }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
};

/// To be called before the first other use of HDF5: its own error output is switched off, the filter of Zstandard
/// registered. Cheap when called again.
void prepare_hdf5();

}  // namespace rheocyte
