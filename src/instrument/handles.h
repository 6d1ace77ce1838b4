// What the handles of the C interface point to. A number shows whether a pointer is one of them.
#pragma once
#include <cstdint>
#include <memory>

#include "instrument/worker.h"

struct rheocyte_cell_setup {
  static constexpr std::uint64_t kind = 0x7268656f73657475;  // "rheosetu"
  std::uint64_t is = kind;
  std::unique_ptr<rheocyte::SetUp> content;
};

struct rheocyte_cell_worker {
  static constexpr std::uint64_t kind = 0x7268656f776f726b;  // "rheowork"
  std::uint64_t is = kind;
  std::unique_ptr<rheocyte::Worker> content;
};

namespace rheocyte {

/// RHEOCYTE_CELL_OK if it is a handle of this kind.
template <class Handle>
std::int32_t checked(const Handle* handle) {
  if (handle == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  const bool is_aligned = reinterpret_cast<std::uintptr_t>(handle) % alignof(Handle) == 0;
  return is_aligned && handle->is == Handle::kind ? RHEOCYTE_CELL_OK : RHEOCYTE_CELL_WRONG_HANDLE;
}

}  // namespace rheocyte
