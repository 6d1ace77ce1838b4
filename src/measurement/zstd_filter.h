// Zstandard compression inside HDF5: almost all modern recordings use it, and HDF5 itself does not bring it.
#pragma once

namespace rheocyte {

inline constexpr int zstd_filter_number = 32015;  ///< registered with The HDF Group

/// Registers the filter with HDF5 for this process; its one parameter is the level of compression (3 if none is given).
void register_zstd_filter();

}  // namespace rheocyte
