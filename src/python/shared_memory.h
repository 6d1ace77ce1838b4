// Memory that a child of the process fills and the process reads.
#pragma once
#include <cstddef>
#include <memory>

namespace rheocyte {

class SharedMemory {
 public:
  /// std::system_error if there is no memory to share.
  SharedMemory();
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// In the child: behind what was written before. std::bad_alloc.
  void append(const void* data, std::size_t size) const;

  /// In the parent: the first `size` bytes, which stay as long as the pointer. std::bad_alloc.
  std::shared_ptr<char> bytes(std::size_t size) const;

 private:
  struct Place;
  std::unique_ptr<Place> place_;
};

}  // namespace rheocyte
