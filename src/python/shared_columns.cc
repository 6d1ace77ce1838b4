#include "python/shared_columns.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <memory>
#include <new>
#include <system_error>

#include "python/isolated_reading.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

constexpr std::size_t alignment = sizeof(double);

std::size_t aligned(std::size_t size) { return (size + alignment - 1) / alignment * alignment; }

struct Mapping {
  std::size_t size;
  char* start;

  Mapping(int descriptor, std::size_t bytes)
      : size(bytes),
        start(static_cast<char*>(::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE, descriptor, 0))) {
    if (start == MAP_FAILED) throw std::bad_alloc();
  }
  ~Mapping() { ::munmap(start, size); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
};

}  // namespace

std::size_t taken_addresses() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

SharedColumns::SharedColumns() : descriptor_(::memfd_create("rheocyte-columns", MFD_CLOEXEC)) {
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
}

SharedColumns::~SharedColumns() { ::close(descriptor_); }

void SharedColumns::append(const void* data, std::size_t size) const {
  const char* from = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t count = ::write(descriptor_, from, size);
    if (count < 0 && errno != EINTR) throw std::bad_alloc();
    if (count < 0) continue;
    from += count;
    size -= static_cast<std::size_t>(count);
  }
}

void SharedColumns::write(std::span<const double> column) const { append(column.data(), column.size_bytes()); }

void SharedColumns::write(std::span<const std::int8_t> column) const {
  constexpr char nothing[alignment] = {};
  append(column.data(), column.size());
  append(nothing, aligned(column.size()) - column.size());
}

py::tuple SharedColumns::arrays(const std::vector<SharedColumn>& columns, std::size_t length) const {
  const auto size_of = [&](const SharedColumn& column) {
    return aligned(length * (column.is_bytes ? 1 : sizeof(double)));
  };
  std::size_t size = 1;  // nothing cannot be mapped
  for (const auto& column : columns) size += size_of(column);
  const auto mapping = std::make_shared<Mapping>(descriptor_, size);
  py::dict arrays, units, words;
  const char* at = mapping->start;
  for (const auto& column : columns) {
    const py::capsule owner(new std::shared_ptr<Mapping>(mapping),
                            [](void* kept) { delete static_cast<std::shared_ptr<Mapping>*>(kept); });
    const py::dtype type = column.is_bytes ? py::dtype::of<std::int8_t>() : py::dtype::of<double>();
    arrays[column.name.c_str()] = py::array(type, {static_cast<py::ssize_t>(length)}, {}, at, owner);
    at += size_of(column);
    units[column.name.c_str()] = column.unit;
    if (!column.words.empty()) words[column.name.c_str()] = column.words;
  }
  py::dict said;
  said["units"] = units;
  said["words"] = words;
  return py::make_tuple(arrays, said);
}

}  // namespace rheocyte
