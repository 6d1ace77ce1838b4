// What a program does before all else.
#pragma once

namespace rheocyte {

/// The arguments in UTF-8; from now on streams and files hold the same bytes everywhere.
char** begin_program(int& count, char** arguments);

}  // namespace rheocyte
