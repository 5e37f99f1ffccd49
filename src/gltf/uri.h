// URIs in a glTF: data in base64, or a file beside the scene. Nothing else: there is no network here.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scumble::gltf {

bool isDataUri(std::string_view uri);
// Whether it lies on the network, which nobody here asks.
bool isRemoteUri(std::string_view uri);

// The bytes of "data:[<type>][;base64],<data>" (RFC 2397), also with line breaks and percent encoding within;
// fails on anything else.
std::vector<uint8_t> decodeDataUri(std::string_view uri, const std::string& jsonPath);

// The path of a file named by a relative URI: percent encoding undone, `\` for `/`, without ?query and
// #fragment unless there is a file of that very name. Fails for other schemes, and for what leads out of
// `folder` unless `allowOutside`. An empty folder: the scene is in memory and has no files.
std::string resolveFileUri(std::string_view uri, const std::string& folder, bool allowOutside,
                           const std::string& jsonPath);

}  // namespace scumble::gltf
