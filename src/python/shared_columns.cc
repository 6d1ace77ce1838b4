#include "python/shared_columns.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>

namespace rheocyte {

namespace py = pybind11;

namespace {

constexpr std::size_t alignment = sizeof(double);

std::size_t aligned(std::size_t size) { return (size + alignment - 1) / alignment * alignment; }

}  // namespace

void SharedColumns::write(std::span<const double> column) const { memory_.append(column.data(), column.size_bytes()); }

void SharedColumns::write(std::span<const std::int8_t> column) const {
  constexpr char nothing[alignment] = {};
  memory_.append(column.data(), column.size());
  memory_.append(nothing, aligned(column.size()) - column.size());
}

py::tuple SharedColumns::arrays(const std::vector<SharedColumn>& columns, std::size_t length) const {
  const auto size_of = [&](const SharedColumn& column) {
    return aligned(length * (column.is_bytes ? 1 : sizeof(double)));
  };
  std::size_t size = 1;  // nothing cannot be mapped
  for (const auto& column : columns) size += size_of(column);
  const std::shared_ptr<char> start = memory_.bytes(size);
  py::dict arrays, units, words;
  const char* at = start.get();
  for (const auto& column : columns) {
    const py::capsule owner(new std::shared_ptr<char>(start),
                            [](void* kept) { delete static_cast<std::shared_ptr<char>*>(kept); });
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
