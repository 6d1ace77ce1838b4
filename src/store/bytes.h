// Values as bytes and back, for files and pipes that only this program reads.
//
// Numbers, and structs of numbers, are their memory; texts and lists are a count (64 bits) and their elements; matrices
// of Eigen their rows (64 bits) and their numbers. Any other struct names its fields, in the order of the bytes, by
//   template <class Self> static auto fields(Self& self) { return std::tie(self.first, self.second); }
// in itself or in a specialisation of FieldsOf.
#pragma once
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace rheocyte {

template <class T>
struct FieldsOf {
  template <class Self>
  requires requires(Self& self) { T::fields(self); }
  static auto fields(Self& self) { return T::fields(self); }
};

template <class T>
concept HasFields = requires(T& value) {
  FieldsOf<T>::fields(value);
};
template <class T>
concept IsMatrix = requires(T& value) {
  value.rows();
  value.data();
  T::ColsAtCompileTime;
};
template <class T>
concept IsList = requires(T& value) {
  value.clear();
  value.emplace_back();
};

class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    if constexpr (HasFields<T>) {
      std::apply([this](const auto&... field) { (this->put(field), ...); }, FieldsOf<T>::fields(value));
    } else if constexpr (IsMatrix<T>) {
      put(std::int64_t(value.rows()));
      append(value.data(), sizeof(*value.data()) * std::size_t(value.size()));
    } else if constexpr (std::is_same_v<T, std::string>) {
      put(std::uint64_t(value.size()));
      append(value.data(), value.size());
    } else if constexpr (IsList<T>) {
      put(std::uint64_t(value.size()));
      for (const auto& element : value) put(element);
    } else {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>, "this type must name its fields");
      append(&value, sizeof value);
    }
  }
  std::string& bytes() { return bytes_; }

 private:
  void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  std::string bytes_;
};

/// Reads nothing beyond the end, and makes nothing larger than the bytes can fill: `failed` then stays true.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void take(T& value) {
    if constexpr (HasFields<T>) {
      std::apply([this](auto&... field) { (this->take(field), ...); }, FieldsOf<T>::fields(value));
    } else if constexpr (IsMatrix<T>) {
      constexpr std::size_t row = sizeof(*value.data()) * std::size_t(T::ColsAtCompileTime);
      const std::size_t rows = count(row);
      value.resize(static_cast<typename T::Index>(rows), T::ColsAtCompileTime);
      copy(value.data(), row * rows);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value.resize(count(1));
      copy(value.data(), value.size());
    } else if constexpr (IsList<T>) {
      value.clear();
      for (std::size_t rest = count(1); rest > 0 && !failed; --rest) take(value.emplace_back());
    } else {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>, "this type must name its fields");
      copy(&value, sizeof value);
    }
  }
  bool at_end() const { return bytes_.empty() && !failed; }
  bool failed = false;

 private:
  std::size_t count(std::size_t element_size) {
    std::uint64_t number = 0;
    take(number);
    if (number > bytes_.size() / element_size) failed = true;
    return failed ? 0 : std::size_t(number);
  }
  void copy(void* target, std::size_t size) {
    if (failed || size > bytes_.size()) {
      failed = true;
      return;
    }
    if (size > 0) std::memcpy(target, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  std::string_view bytes_;
};

template <class T>
std::string to_bytes(const T& value) {
  ByteWriter writer;
  writer.put(value);
  return std::move(writer.bytes());
}

/// Nothing if the bytes are too few, too many or damaged.
template <class T>
std::optional<T> from_bytes(std::string_view bytes) {
  ByteReader reader(bytes);
  std::optional<T> value(std::in_place);
  reader.take(*value);
  if (!reader.at_end()) value.reset();
  return value;
}

}  // namespace rheocyte
