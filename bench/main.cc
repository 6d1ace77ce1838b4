#include <cstdio>

#include "case/user_error.h"
#include "program.h"

int main(int argc, char** argv) {
  try {
    return rheocyte::measure(argc, argv);
  } catch (const rheocyte::UserError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
