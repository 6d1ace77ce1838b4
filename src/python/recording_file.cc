// New recordings, into which an open dataset of another library is put.
#include "measurement/recording_file.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <span>
#include <string>
#include <vector>

#include "python/bindings.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

using Column = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Masks = py::array_t<std::uint8_t, py::array::c_style>;

void append(RecordingFile& file, const std::string& feature, const Column& column) {
  file.append(feature, {column.data(), static_cast<std::size_t>(column.size())});
}

// (events, rows, columns).
void append_masks(RecordingFile& file, const Masks& masks) {
  const ImageSize size{static_cast<std::size_t>(masks.shape(2)), static_cast<std::size_t>(masks.shape(1))};
  file.append_images("mask", size, {masks.data(), static_cast<std::size_t>(masks.size())});
}

}  // namespace

const Binding bind_recording_file([](py::module_& module) {
  using File = RecordingFile;
  py::class_<File>(module, "RecordingFile")
      .def(py::init<const std::filesystem::path&>())
      .def("add_metadata", py::overload_cast<const std::string&, std::int64_t>(&File::add_metadata))
      .def("add_metadata", py::overload_cast<const std::string&, double>(&File::add_metadata))
      .def("add_metadata", py::overload_cast<const std::string&, const std::string&>(&File::add_metadata))
      .def("append", &append)
      .def("append_masks", &append_masks)
      .def("add_basin", &File::add_basin)
      .def("add_log", &File::add_log)
      .def("close", &File::close);
});

}  // namespace rheocyte
