# Writes OUT, a header with the SPIR-V words of IN as an array called NAME.
file(READ ${IN} hex HEX)
# Words are little-endian in the file.
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
file(WRITE ${OUT} "#pragma once
#include <cstdint>
namespace scumble::shaders {
inline constexpr uint32_t ${NAME}[] = {${words}};
}
")
