#include "python/shared_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>

namespace rheocyte {

struct SharedMemory::Place {
  int descriptor;
};

SharedMemory::SharedMemory() : place_(new Place{::memfd_create("rheocyte-columns", MFD_CLOEXEC)}) {
  if (place_->descriptor < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
}

SharedMemory::~SharedMemory() { ::close(place_->descriptor); }

void SharedMemory::append(const void* data, std::size_t size) const {
  const char* from = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t count = ::write(place_->descriptor, from, size);
    if (count < 0 && errno != EINTR) throw std::bad_alloc();
    if (count < 0) continue;
    from += count;
    size -= static_cast<std::size_t>(count);
  }
}

std::shared_ptr<char> SharedMemory::bytes(std::size_t size) const {
  void* const start = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE, place_->descriptor, 0);
  if (start == MAP_FAILED) throw std::bad_alloc();
  return {static_cast<char*>(start), [size](char* mapped) { ::munmap(mapped, size); }};
}

}  // namespace rheocyte
