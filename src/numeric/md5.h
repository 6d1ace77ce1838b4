// The MD5 digest (RFC 1321): programs of the field name measurements by it. It keeps no secrets.
#pragma once
#include <string>
#include <string_view>

namespace rheocyte {

/// 32 hexadecimal digits.
std::string md5(std::string_view bytes);

}  // namespace rheocyte
