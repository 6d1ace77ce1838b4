// Who works on a file or a folder.
#pragma once
#include <filesystem>

namespace rheocyte {

/// An open file or folder and, where the file system knows locks, a lock on it. The system gives both up when the
/// process and its children end, however they end.
class Claim {
 public:
  Claim() = default;
  explicit Claim(int descriptor) : descriptor_(descriptor) {}
  Claim(Claim&& other) noexcept;
  Claim& operator=(Claim&& other) noexcept;
  ~Claim();
  explicit operator bool() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

/// Of a file or folder that is there. False if it is held already, is none, or its file system knows no locks.
Claim claim_on(const std::filesystem::path&);

/// Waits until nobody else holds the folder; without locks it does not wait.
Claim wait_for_folder(const std::filesystem::path&);

}  // namespace rheocyte
