// What each program of this folder is, but those that Google Benchmark runs by itself; main.cc calls it.
#pragma once

namespace rheocyte {

/// Exit code of the process. A UserError ends it with its sentence on standard error and the code 2.
int measure(int argc, char** argv);

}  // namespace rheocyte
