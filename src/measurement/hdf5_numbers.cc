#include "measurement/hdf5_numbers.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "measurement/hdf5_reading.h"

namespace rheocyte {

namespace {

constexpr std::size_t piece_bytes = 1 << 20;

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

// Truth values are an enumeration, which HDF5 does not convert to numbers; its memory is that of its base type.
Hdf5Handle type_in_memory(hid_t file_type, hid_t wanted) {
  if (::H5Tget_class(file_type) != H5T_ENUM) return Hdf5Handle(::H5Tcopy(wanted));
  return Hdf5Handle(::H5Tget_native_type(file_type, H5T_DIR_ASCEND));
}

// A whole number of `size` bytes, with its sign.
std::int64_t widened(const unsigned char* bytes, std::size_t size, bool has_sign) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes, size);
  const unsigned unused = 64 - 8 * static_cast<unsigned>(size);
  const auto shifted = static_cast<std::int64_t>(value << unused);
  return has_sign ? shifted >> unused : static_cast<std::int64_t>(value);
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

/// Looks whether pieces of data are there and under their checksums: HDF5 itself would take zeros for what is missing.
class ChunkCheck {
 public:
  explicit ChunkCheck(const OpenDataset& data) : data_(data), properties_(::H5Dget_create_plist(data.dataset.get())) {
    const auto rank = data.shape.extent.size();
    extent_.assign(data.shape.extent.begin(), data.shape.extent.end());
    chunk_.resize(rank);
    good_ = properties_ && ::H5Pget_chunk(properties_.get(), int(rank), chunk_.data()) == int(rank);
    if (good_) no_checksum_ = missing_checksum_bit(properties_.get());
  }

  /// Rows [first, first + rows).
  bool are_sound(std::size_t first, std::size_t rows) {
    for (std::size_t c = first / chunk_[0]; good_ && c * chunk_[0] < first + rows; ++c) {
      if (c >= data_.sound.size()) data_.sound.resize(c + 1);
      if (!data_.sound[c]) data_.sound[c] = good_ = row_is_sound(c * chunk_[0]);
    }
    return good_;
  }

 private:
  // All pieces of one row of chunks.
  bool row_is_sound(hsize_t first) {
    std::vector<hsize_t> at(chunk_.size(), 0);
    at[0] = first;
    for (std::size_t axis = at.size(); axis > 0;) {
      if (!is_sound(at)) return false;
      for (axis = at.size() - 1; axis > 0; --axis) {  // the next place, last axis first
        at[axis] += chunk_[axis];
        if (at[axis] < extent_[axis]) break;
        at[axis] = 0;
      }
    }
    return true;
  }

  // HDF5 1.10 looks a place up in its index here; H5Dget_chunk_info_by_coord would walk through all of it.
  bool is_sound(const std::vector<hsize_t>& at) {
    hsize_t size = 0;
    const hid_t dataset = data_.dataset.get();
    if (::H5Dget_chunk_storage_size(dataset, at.data(), &size) < 0 || size == 0) return false;
    if (no_checksum_ == 0) return true;
    if (size > reading_limits.chunk_bytes) return false;
    raw_.resize(size);
    std::uint32_t mask = 0;
    return ::H5Dread_chunk(dataset, H5P_DEFAULT, at.data(), &mask, raw_.data()) >= 0 && (mask & no_checksum_) == 0;
  }

  const OpenDataset& data_;
  Hdf5Handle properties_;
  std::vector<hsize_t> extent_, chunk_;
  std::vector<unsigned char> raw_;
  unsigned no_checksum_ = 0;
  bool good_ = false;
};

// The values of an enumeration, widened.
template <class Number>
bool read_enumeration(hid_t dataset, hid_t memory_type, hid_t memory_space, hid_t file_space,
                      std::span<Number> values) {
  const std::size_t size = ::H5Tget_size(memory_type);
  if (size == 0 || size > sizeof(std::int64_t)) return false;
  const bool has_sign = ::H5Tget_sign(memory_type) == H5T_SGN_2;
  std::vector<unsigned char> raw(size * values.size());
  if (::H5Dread(dataset, memory_type, memory_space, file_space, H5P_DEFAULT, raw.data()) < 0) return false;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<Number>(widened(raw.data() + i * size, size, has_sign));
  return true;
}

template <class Number>
bool read_piece(hid_t dataset, std::size_t first, std::size_t rows, std::span<Number> values) {
  const Hdf5Handle space(::H5Dget_space(dataset)), type(::H5Dget_type(dataset));
  if (!space || !type) return false;
  const Hdf5Handle memory = select_rows(space.get(), first, rows);
  if (!memory || ::H5Sget_simple_extent_npoints(memory.get()) != static_cast<hssize_t>(values.size())) return false;
  const Hdf5Handle memory_type = type_in_memory(type.get(), native_type<Number>());
  if (!memory_type) return false;
  if (::H5Tget_class(memory_type.get()) == H5T_ENUM)
    return read_enumeration(dataset, memory_type.get(), memory.get(), space.get(), values);
  return ::H5Dread(dataset, memory_type.get(), memory.get(), space.get(), H5P_DEFAULT, values.data()) >= 0;
}

// Whole chunks, so that none is decompressed twice.
std::size_t rows_in_a_piece(const DatasetShape& shape, std::size_t bytes_of_a_row) {
  const std::size_t rows = std::max<std::size_t>(piece_bytes / std::max<std::size_t>(bytes_of_a_row, 1), 1);
  const std::size_t chunk = std::max<std::size_t>(shape.rows_per_chunk, 1);
  return rows > chunk ? rows / chunk * chunk : chunk;
}

// Never written, such data read as their fill value.
bool is_never_written(hid_t dataset) {
  const Hdf5Handle properties(::H5Dget_create_plist(dataset));
  return properties && ::H5Pget_layout(properties.get()) == H5D_CONTIGUOUS && ::H5Dget_offset(dataset) == HADDR_UNDEF;
}

template <class Number>
bool read_rows_as(const OpenDataset& data, std::size_t first, std::span<Number> values, const PieceRead& on_piece) {
  const std::size_t width = data.shape.width();
  if (width == 0 || values.size() % width != 0) return false;
  const std::size_t rows = values.size() / width, piece = rows_in_a_piece(data.shape, width * sizeof(Number));
  if (rows == 0) return true;
  if (first > data.shape.rows() || rows > data.shape.rows() - first) return false;
  std::optional<ChunkCheck> check;
  if (data.shape.rows_per_chunk > 0)
    check.emplace(data);
  else if (is_never_written(data.dataset.get()))
    return false;
  for (std::size_t done = 0; done < rows;) {
    const std::size_t count = std::min(piece - (first + done) % piece, rows - done);
    if (check && !check->are_sound(first + done, count)) return false;
    if (!read_piece(data.dataset.get(), first + done, count, values.subspan(done * width, count * width))) return false;
    done += count;
    if (on_piece) on_piece();
  }
  return true;
}

std::optional<DatasetShape> numeric_shape(hid_t dataset, std::uintmax_t file_bytes) {
  // First of all: asked for the size of virtual data, HDF5 opens the files in which they lie.
  const Hdf5Handle properties(::H5Dget_create_plist(dataset));
  if (!properties || !lies_in_the_file(properties.get())) return std::nullopt;
  const Hdf5Handle space(::H5Dget_space(dataset)), type(::H5Dget_type(dataset));
  if (!space || !type || !is_number(type.get())) return std::nullopt;
  const int dimensions = ::H5Sget_simple_extent_ndims(space.get());
  if (dimensions < 1 || dimensions > 4) return std::nullopt;
  std::vector<hsize_t> extent(dimensions), chunk(dimensions);
  ::H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  const auto size = static_cast<double>(::H5Tget_size(type.get()));
  const auto bytes = [&](const std::vector<hsize_t>& sides) {
    return std::accumulate(sides.begin(), sides.end(), size, [](double a, hsize_t b) { return a * double(b); });
  };
  if (bytes(extent) > reading_limits.max_compression * static_cast<double>(file_bytes)) return std::nullopt;
  const bool single_precision = ::H5Tget_class(type.get()) == H5T_FLOAT && ::H5Tget_size(type.get()) == 4;
  DatasetShape shape{{extent.begin(), extent.end()}, 0, single_precision};
  if (::H5Pget_layout(properties.get()) != H5D_CHUNKED) return shape;
  if (::H5Pget_chunk(properties.get(), dimensions, chunk.data()) != dimensions ||
      bytes(chunk) > static_cast<double>(reading_limits.chunk_bytes))
    return std::nullopt;
  shape.rows_per_chunk = chunk[0];
  return shape;
}

}  // namespace

std::size_t DatasetShape::width() const {
  return extent.empty() ? 0 : std::accumulate(extent.begin() + 1, extent.end(), std::size_t{1}, std::multiplies<>());
}

bool DatasetShape::is_pictures() const {
  return extent.size() == 3 && width() > 0 && std::max(extent[1], extent[2]) <= reading_limits.image_side;
}

bool lies_in_the_file(hid_t properties) {
  const auto layout = ::H5Pget_layout(properties);
  return layout == H5D_CHUNKED || layout == H5D_COMPACT ||
         (layout == H5D_CONTIGUOUS && ::H5Pget_external_count(properties) == 0);
}

std::optional<OpenDataset> open_numbers(hid_t parent, const std::string& name, std::uintmax_t file_bytes) {
  Hdf5Handle dataset = open_dataset(parent, name);
  auto shape = dataset ? numeric_shape(dataset.get(), file_bytes) : std::nullopt;
  if (!shape) return std::nullopt;
  return OpenDataset{std::move(dataset), std::move(*shape)};
}

bool read_rows(const OpenDataset& data, std::size_t first, std::span<double> values, const PieceRead& on_piece) {
  return read_rows_as(data, first, values, on_piece);
}

bool read_rows(const OpenDataset& data, std::size_t first, std::span<std::uint8_t> values, const PieceRead& on_piece) {
  return read_rows_as(data, first, values, on_piece);
}

bool read_rows(const OpenDataset& data, std::size_t first, std::span<std::int64_t> values, const PieceRead& on_piece) {
  return read_rows_as(data, first, values, on_piece);
}

std::optional<double> number_in(hid_t attribute) {
  const Hdf5Handle type(::H5Aget_type(attribute)), space(::H5Aget_space(attribute));
  if (!type || !space || !is_number(type.get()) || ::H5Sget_simple_extent_npoints(space.get()) != 1)
    return std::nullopt;
  const Hdf5Handle memory_type = type_in_memory(type.get(), H5T_NATIVE_DOUBLE);
  if (!memory_type) return std::nullopt;
  if (::H5Tget_class(memory_type.get()) == H5T_ENUM) {
    unsigned char bytes[sizeof(std::int64_t)] = {};
    const std::size_t size = ::H5Tget_size(memory_type.get());
    if (size == 0 || size > sizeof bytes || ::H5Aread(attribute, memory_type.get(), bytes) < 0) return std::nullopt;
    return static_cast<double>(widened(bytes, size, ::H5Tget_sign(memory_type.get()) == H5T_SGN_2));
  }
  double value = 0;
  return ::H5Aread(attribute, memory_type.get(), &value) < 0 ? std::nullopt : std::optional<double>(value);
}

}  // namespace rheocyte
