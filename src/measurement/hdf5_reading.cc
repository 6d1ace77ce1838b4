#include "measurement/hdf5_reading.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>

#include "measurement/zstd_filter.h"

namespace rheocyte {

namespace {

bool is_kind(hid_t object, H5I_type_t kind) { return ::H5Iget_type(object) == kind; }

Hdf5Handle open_object(hid_t parent, const std::string& name, H5I_type_t kind) {
  if (::H5Lexists(parent, name.c_str(), H5P_DEFAULT) <= 0) return {};
  Hdf5Handle object(::H5Oopen(parent, name.c_str(), H5P_DEFAULT));
  if (!object || !is_kind(object.get(), kind)) return {};
  return object;
}

struct CollectedNames {
  std::vector<std::string> names;
  bool too_many = false;
};

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* data) {
  auto& collected = *static_cast<CollectedNames*>(data);
  if (collected.names.size() >= reading_limits.names) {
    collected.too_many = true;
    return 1;
  }
  if (std::strlen(name) <= reading_limits.name_length) collected.names.emplace_back(name);
  return 0;
}

// Sign, exponent and mantissa as IEEE 754 has them for 16, 32 and 64 bits; longer ones are as the machine has them.
bool is_common_float(hid_t type, std::size_t size) {
  std::size_t sign = 0, exponent = 0, exponent_bits = 0, mantissa = 0, mantissa_bits = 0;
  if (::H5Tget_fields(type, &sign, &exponent, &exponent_bits, &mantissa, &mantissa_bits) < 0) return false;
  if (size > 8) return ::H5Tequal(type, H5T_NATIVE_LDOUBLE) > 0;
  const std::size_t bits = 8 * size, usual = size == 2 ? 5 : size == 4 ? 8 : 11;
  return size != 1 && sign == bits - 1 && exponent_bits == usual && exponent == bits - 1 - usual && mantissa == 0 &&
         mantissa_bits == exponent && ::H5Tget_ebias(type) == (std::size_t{1} << (usual - 1)) - 1;
}

// Numbers that fill all of their bits. HDF5 could convert others, but a damaged description of a type is more likely.
bool is_number(hid_t type) {
  const std::size_t size = ::H5Tget_size(type);
  switch (::H5Tget_class(type)) {
    case H5T_ENUM: return size <= 8;
    case H5T_INTEGER: return size <= 8 && ::H5Tget_precision(type) == 8 * size && ::H5Tget_offset(type) == 0;
    case H5T_FLOAT: return size <= 16 && is_common_float(type, size);
    default: return false;
  }
}

// External and virtual storage would let a recording read any other file.
bool lies_in_the_file(hid_t properties) {
  const auto layout = ::H5Pget_layout(properties);
  return layout == H5D_CHUNKED || layout == H5D_COMPACT ||
         (layout == H5D_CONTIGUOUS && ::H5Pget_external_count(properties) == 0);
}

// Truth values are an enumeration, which HDF5 does not convert to numbers; its memory is that of its base type.
Hdf5Handle type_in_memory(hid_t file_type, hid_t wanted) {
  if (::H5Tget_class(file_type) != H5T_ENUM) return Hdf5Handle(::H5Tcopy(wanted));
  return Hdf5Handle(::H5Tget_native_type(file_type, H5T_DIR_ASCEND));
}

template <class Number>
hid_t native_type() {
  if constexpr (std::is_same_v<Number, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<Number, std::uint8_t>) return H5T_NATIVE_UINT8;
  return H5T_NATIVE_INT64;
}

Hdf5Handle select_rows(hid_t space, std::size_t first, std::size_t rows) {
  const int dimensions = ::H5Sget_simple_extent_ndims(space);
  if (dimensions < 1) return {};
  std::vector<hsize_t> extent(dimensions), start(dimensions, 0);
  ::H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  if (first > extent[0] || rows > extent[0] - first) return {};
  start[0] = first;
  extent[0] = rows;
  if (::H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) < 0) return {};
  return Hdf5Handle(::H5Screate_simple(dimensions, extent.data(), nullptr));
}

// The bit that says of a piece of data that it has no checksum, although the dataset has them; 0 without checksums.
unsigned missing_checksum_bit(hid_t properties) {
  const int count = ::H5Pget_nfilters(properties);
  for (int i = 0; i < count && i < 32; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    if (::H5Pget_filter2(properties, unsigned(i), &flags, &values, nullptr, 0, nullptr, nullptr) ==
        H5Z_FILTER_FLETCHER32)
      return 1U << unsigned(i);
  }
  return 0;
}

// Whether every piece of data that the rows need is there and under its checksum. HDF5 itself would take zeros for
// what is missing.
bool chunks_are_sound(hid_t dataset, hid_t file_space, std::size_t first, std::size_t rows) {
  const Hdf5Handle properties(::H5Dget_create_plist(dataset));
  if (!properties) return false;
  if (::H5Pget_layout(properties.get()) != H5D_CHUNKED) return true;
  const int dimensions = ::H5Sget_simple_extent_ndims(file_space);
  std::vector<hsize_t> extent(dimensions), chunk(dimensions);
  ::H5Sget_simple_extent_dims(file_space, extent.data(), nullptr);
  if (::H5Pget_chunk(properties.get(), dimensions, chunk.data()) != dimensions) return false;
  const unsigned no_checksum = missing_checksum_bit(properties.get());
  const hsize_t start = first / chunk[0] * chunk[0];
  std::vector<hsize_t> at(dimensions, 0);
  at[0] = start;
  extent[0] = first + rows;
  for (int axis = 0; axis >= 0;) {
    unsigned mask = 0;
    haddr_t address = HADDR_UNDEF;
    hsize_t size = 0;
    if (::H5Dget_chunk_info_by_coord(dataset, at.data(), &mask, &address, &size) < 0 || address == HADDR_UNDEF ||
        (mask & no_checksum) != 0)
      return false;
    for (axis = dimensions - 1; axis >= 0; --axis) {  // the next place, last axis first
      at[axis] += chunk[axis];
      if (at[axis] < extent[axis]) break;
      at[axis] = axis == 0 ? start : 0;
    }
  }
  return true;
}

// The values of an enumeration, widened.
template <class Number>
bool read_enumeration(hid_t dataset, hid_t memory_type, hid_t memory_space, hid_t file_space,
                      std::span<Number> values) {
  const std::size_t size = ::H5Tget_size(memory_type);
  if (size > sizeof(std::int64_t)) return false;
  std::vector<unsigned char> raw(size * values.size());
  if (::H5Dread(dataset, memory_type, memory_space, file_space, H5P_DEFAULT, raw.data()) < 0) return false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::int64_t value = 0;
    std::memcpy(&value, raw.data() + i * size, size);
    values[i] = static_cast<Number>(value);
  }
  return true;
}

template <class Number>
bool read_rows_as(hid_t dataset, std::size_t first, std::size_t rows, std::span<Number> values) {
  if (rows == 0) return true;
  const Hdf5Handle space(::H5Dget_space(dataset)), type(::H5Dget_type(dataset));
  if (!space || !type) return false;
  const Hdf5Handle memory = select_rows(space.get(), first, rows);
  if (!chunks_are_sound(dataset, space.get(), first, rows)) return false;
  if (!memory || ::H5Sget_simple_extent_npoints(memory.get()) != static_cast<hssize_t>(values.size())) return false;
  const Hdf5Handle memory_type = type_in_memory(type.get(), native_type<Number>());
  if (!memory_type) return false;
  if (::H5Tget_class(memory_type.get()) == H5T_ENUM)
    return read_enumeration(dataset, memory_type.get(), memory.get(), space.get(), values);
  return ::H5Dread(dataset, memory_type.get(), memory.get(), space.get(), H5P_DEFAULT, values.data()) >= 0;
}

std::string text_of(const char* data, std::size_t longest) { return {data, ::strnlen(data, longest)}; }

// Texts of one attribute or dataset: `read` fills a buffer with elements of the given type.
using Reader = std::function<bool(hid_t type, void* buffer)>;

std::optional<std::vector<std::string>> texts(hid_t type, hid_t space, const Reader& read) {
  const hssize_t count = ::H5Sget_simple_extent_npoints(space);
  if (count < 0 || static_cast<std::size_t>(count) > reading_limits.text_lines) return std::nullopt;
  std::vector<std::string> lines;
  if (count == 0) return lines;
  const Hdf5Handle memory_type(::H5Tcopy(type));
  if (::H5Tis_variable_str(type) > 0) {
    std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
    if (!read(memory_type.get(), static_cast<void*>(pointers.data()))) return std::nullopt;
    for (const char* text : pointers) lines.push_back(text ? text_of(text, reading_limits.text_length) : "");
    ::H5Dvlen_reclaim(memory_type.get(), space, H5P_DEFAULT, static_cast<void*>(pointers.data()));
    return lines;
  }
  const std::size_t size = ::H5Tget_size(type);
  if (size == 0 || size > reading_limits.text_length || size * static_cast<std::size_t>(count) > (64U << 20U))
    return std::nullopt;
  std::vector<char> characters(size * static_cast<std::size_t>(count));
  if (!read(memory_type.get(), characters.data())) return std::nullopt;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    lines.push_back(text_of(characters.data() + i * size, size));
  return lines;
}

std::optional<double> number_in(hid_t attribute, hid_t type) {
  const Hdf5Handle memory_type = type_in_memory(type, H5T_NATIVE_DOUBLE);
  if (!memory_type) return std::nullopt;
  if (::H5Tget_class(memory_type.get()) == H5T_ENUM) {
    std::int64_t value = 0;
    if (::H5Tget_size(memory_type.get()) > sizeof value) return std::nullopt;
    return ::H5Aread(attribute, memory_type.get(), &value) < 0 ? std::nullopt : std::optional<double>(value);
  }
  double value = 0;
  return ::H5Aread(attribute, memory_type.get(), &value) < 0 ? std::nullopt : std::optional<double>(value);
}

std::optional<Metadata::Value> value_of(hid_t attribute) {
  const Hdf5Handle type(::H5Aget_type(attribute)), space(::H5Aget_space(attribute));
  if (!type || !space || ::H5Sget_simple_extent_npoints(space.get()) != 1) return std::nullopt;
  if (is_number(type.get())) {
    const auto number = number_in(attribute, type.get());
    return number ? std::optional<Metadata::Value>(*number) : std::nullopt;
  }
  if (::H5Tget_class(type.get()) != H5T_STRING) return std::nullopt;
  const auto lines = texts(type.get(), space.get(), [&](hid_t memory_type, void* buffer) {
    return ::H5Aread(attribute, memory_type, buffer) >= 0;
  });
  return lines && lines->size() == 1 ? std::optional<Metadata::Value>(lines->front()) : std::nullopt;
}

herr_t collect_attribute(hid_t object, const char* name, const H5A_info_t*, void* data) {
  auto& values = *static_cast<std::map<std::string, Metadata::Value>*>(data);
  if (values.size() >= reading_limits.text_lines) return 1;
  if (std::strlen(name) > reading_limits.name_length) return 0;
  const Hdf5Handle attribute(::H5Aopen(object, name, H5P_DEFAULT));
  if (!attribute) return 0;
  if (auto value = value_of(attribute.get())) values.emplace(name, std::move(*value));
  return 0;
}

}  // namespace

void prepare_hdf5() {
  static const bool done = [] {
    ::H5open();
    ::H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    register_zstd_filter();
    return true;
  }();
  static_cast<void>(done);
}

Hdf5Handle open_group(hid_t parent, const std::string& name) { return open_object(parent, name, H5I_GROUP); }

Hdf5Handle open_dataset(hid_t parent, const std::string& name) { return open_object(parent, name, H5I_DATASET); }

std::optional<std::vector<std::string>> member_names(hid_t group) {
  CollectedNames collected;
  if (::H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &collected) < 0) return std::nullopt;
  if (collected.too_many) return std::nullopt;
  return std::move(collected.names);
}

std::optional<DatasetShape> numeric_shape(hid_t dataset, std::uintmax_t file_bytes) {
  const Hdf5Handle space(::H5Dget_space(dataset)), type(::H5Dget_type(dataset));
  const Hdf5Handle properties(::H5Dget_create_plist(dataset));
  if (!space || !type || !properties || !is_number(type.get()) || !lies_in_the_file(properties.get()))
    return std::nullopt;
  const int dimensions = ::H5Sget_simple_extent_ndims(space.get());
  if (dimensions < 1 || dimensions > 4) return std::nullopt;
  std::vector<hsize_t> extent(dimensions), chunk(dimensions);
  ::H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  const auto size = static_cast<double>(::H5Tget_size(type.get()));
  const auto bytes = [&](const std::vector<hsize_t>& sides) {
    return std::accumulate(sides.begin(), sides.end(), size, [](double a, hsize_t b) { return a * double(b); });
  };
  if (bytes(extent) > reading_limits.greatest_compression * static_cast<double>(file_bytes)) return std::nullopt;
  const bool single_precision = ::H5Tget_class(type.get()) == H5T_FLOAT && ::H5Tget_size(type.get()) == 4;
  DatasetShape shape{{extent.begin(), extent.end()}, 0, single_precision};
  if (::H5Pget_layout(properties.get()) != H5D_CHUNKED) return shape;
  if (::H5Pget_chunk(properties.get(), dimensions, chunk.data()) != dimensions ||
      bytes(chunk) > static_cast<double>(reading_limits.chunk_bytes))
    return std::nullopt;
  shape.rows_per_chunk = chunk[0];
  return shape;
}

bool read_rows(hid_t dataset, std::size_t first, std::size_t rows, std::span<double> values) {
  return read_rows_as(dataset, first, rows, values);
}

bool read_rows(hid_t dataset, std::size_t first, std::size_t rows, std::span<std::uint8_t> values) {
  return read_rows_as(dataset, first, rows, values);
}

bool read_rows(hid_t dataset, std::size_t first, std::size_t rows, std::span<std::int64_t> values) {
  return read_rows_as(dataset, first, rows, values);
}

std::optional<std::vector<std::string>> read_lines(hid_t dataset, std::uintmax_t file_bytes) {
  const Hdf5Handle space(::H5Dget_space(dataset)), type(::H5Dget_type(dataset));
  const Hdf5Handle properties(::H5Dget_create_plist(dataset));
  if (!space || !type || !properties || ::H5Tget_class(type.get()) != H5T_STRING || !lies_in_the_file(properties.get()))
    return std::nullopt;
  const double bytes =
      static_cast<double>(::H5Sget_simple_extent_npoints(space.get())) * static_cast<double>(::H5Tget_size(type.get()));
  if (bytes > reading_limits.greatest_compression * static_cast<double>(file_bytes)) return std::nullopt;
  return texts(type.get(), space.get(), [&](hid_t memory_type, void* buffer) {
    return ::H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer) >= 0;
  });
}

Metadata read_attributes(hid_t object) {
  std::map<std::string, Metadata::Value> values;
  ::H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &values);
  return Metadata(std::move(values));
}

}  // namespace rheocyte
