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
  /// Gives it up. 0, or the number of the error (errno): what was written to a file may then be lost.
  int close();

 private:
  int descriptor_ = -1;
};

/// A claim, or the number of the error (errno) that stands in its way: EWOULDBLOCK if somebody else has one, for what
/// is made EEXIST if something stands there.
struct Claiming {
  Claim claim;
  int failed = 0;
};

/// Of a file or folder that is there. False if it is held already, is none, or its file system knows no locks.
Claim claim_on(const std::filesystem::path&);

/// Waits until no one else holds the folder; without locks it does not wait.
Claim wait_for_folder(const std::filesystem::path&);

enum class IfHeld { fail, wait };
/// Of a file that is made if it is not there, and only claimed.
Claiming claim_on_mark(const std::filesystem::path&, IfHeld);

/// Makes an empty file that can be written to, or a folder for this user alone; never through a link. Without locks the
/// claim is there all the same.
Claiming make_claimed_file(const std::filesystem::path&);
Claiming make_claimed_folder(const std::filesystem::path&);

}  // namespace rheocyte
