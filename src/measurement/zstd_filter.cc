#include "measurement/zstd_filter.h"

#include <hdf5.h>
#include <zstd.h>

#include <cstddef>

namespace rheocyte {

namespace {

constexpr unsigned long long max_chunk = 1ULL << 30;  // a damaged frame may claim any size

struct Bytes {
  void* data = nullptr;
  std::size_t room = 0, used = 0;  // used = 0: failed
};

// HDF5 frees what a filter returns with its own routine, so memory comes from there.
Bytes decompressed(const void* source, std::size_t size) {
  const auto content = ::ZSTD_getFrameContentSize(source, size);
  if (content == ZSTD_CONTENTSIZE_ERROR || content == ZSTD_CONTENTSIZE_UNKNOWN || content == 0 || content > max_chunk)
    return {};
  Bytes result{::H5allocate_memory(content, false), static_cast<std::size_t>(content), 0};
  if (!result.data) return result;
  const std::size_t written = ::ZSTD_decompress(result.data, result.room, source, size);
  if (!::ZSTD_isError(written)) result.used = written;
  return result;
}

Bytes compressed(const void* source, std::size_t size, int level) {
  Bytes result{nullptr, ::ZSTD_compressBound(size), 0};
  result.data = ::H5allocate_memory(result.room, false);
  if (!result.data) return result;
  const std::size_t written = ::ZSTD_compress(result.data, result.room, source, size, level);
  if (!::ZSTD_isError(written)) result.used = written;
  return result;
}

std::size_t filter(unsigned flags, std::size_t parameter_count, const unsigned* parameters, std::size_t size,
                   std::size_t* room, void** data) {
  const int level = parameter_count > 0 ? static_cast<int>(parameters[0]) : ZSTD_CLEVEL_DEFAULT;
  const Bytes result = (flags & H5Z_FLAG_REVERSE) != 0 ? decompressed(*data, size) : compressed(*data, size, level);
  if (result.used == 0) {
    ::H5free_memory(result.data);
    return 0;
  }
  ::H5free_memory(*data);
  *data = result.data;
  *room = result.room;
  return result.used;
}

}  // namespace

void register_zstd_filter() {
  static const H5Z_class2_t description{
      H5Z_CLASS_T_VERS, zstd_filter_number, 1, 1, "Zstandard compression", nullptr, nullptr, filter};
  if (::H5Zfilter_avail(zstd_filter_number) <= 0) ::H5Zregister(&description);
}

}  // namespace rheocyte
