// Of builds without processes: what is written is read in its place. Compiled, not run (tools/windows).
#include <string>

#include "python/shared_memory.h"

namespace rheocyte {

struct SharedMemory::Place {
  std::shared_ptr<std::string> written = std::make_shared<std::string>();
};

SharedMemory::SharedMemory() : place_(std::make_unique<Place>()) {}

SharedMemory::~SharedMemory() = default;

void SharedMemory::append(const void* data, std::size_t size) const {
  place_->written->append(static_cast<const char*>(data), size);
}

std::shared_ptr<char> SharedMemory::bytes(std::size_t size) const {
  if (place_->written->size() < size) place_->written->resize(size);
  return {place_->written, place_->written->data()};
}

}  // namespace rheocyte
