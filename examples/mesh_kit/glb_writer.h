// Writes a document as a binary glTF 2.0 file.
#pragma once

#include <string>

#include "mesh_kit/document.h"

namespace meshkit {

// One buffer; float positions, normals and UVs, 16 or 32 bit indices. The file appears whole or not at all.
// Returns an empty string, or what went wrong.
std::string writeGlb(const Document& document, const std::string& path, const std::string& generator);

// The whole of a program `NAME OUT.glb` that writes one scene: says what is in it, or what is wrong. Returns
// the exit code.
int generate(int argc, char** argv, const char* name, Document (*makeScene)());

}  // namespace meshkit
