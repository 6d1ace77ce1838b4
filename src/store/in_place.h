// Of builds that do in its place what others do in processes of their own.
#pragma once
#include <mutex>

namespace rheocyte {

/// Held while such work is done: the libraries that it needs, such as HDF5, have room for one thread at a time.
std::recursive_mutex& turn_of_work();

}  // namespace rheocyte
