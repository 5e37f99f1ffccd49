#include "gltf/uri.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "scene/import_failure.h"

namespace scumble::gltf {

using namespace scene;

namespace {

std::string shortened(std::string_view text) {
  std::string result(text.substr(0, 80));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  if (text.size() > 80) result += "...";
  return result;
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percentDecoded(std::string_view uri) {
  std::string result;
  result.reserve(uri.size());
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hexDigit(uri[i + 1]) >= 0 && hexDigit(uri[i + 2]) >= 0) {
      result += static_cast<char>(hexDigit(uri[i + 1]) * 16 + hexDigit(uri[i + 2]));
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

// "http" of "http://..."; empty when the URI is relative.
std::string_view schemeOf(std::string_view uri) {
  for (size_t i = 0; i < uri.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(uri[i]);
    if (c == ':') return uri.substr(0, i);
    if (!std::isalnum(c) && c != '+' && c != '-' && c != '.') break;
    if (i == 0 && !std::isalpha(c)) break;
  }
  return {};
}

constexpr std::array<int8_t, 256> makeBase64Table() {
  std::array<int8_t, 256> table{};
  for (auto& entry : table) entry = -1;
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (int i = 0; i < 64; ++i) table[static_cast<unsigned char>(digits[i])] = static_cast<int8_t>(i);
  table['-'] = 62;  // the URL-safe alphabet, which some exporters use
  table['_'] = 63;
  return table;
}
constexpr std::array<int8_t, 256> kBase64 = makeBase64Table();

// What is before `?` and `#`, where those are no part of a name: a query says how to fetch, not what.
std::string_view withoutQuery(std::string_view uri) {
  return uri.substr(0, std::min(uri.find('?'), uri.find('#')));
}

// Whether a path does not lead out of a folder.
bool isInside(const std::string& path) {
  const std::filesystem::path relative = std::filesystem::path(path).lexically_normal();
  return !relative.is_absolute() && (relative.empty() || *relative.begin() != "..");
}

bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f';
}

bool equalsInSmall(std::string_view text, std::string_view small) {
  return text.size() == small.size() &&
         std::equal(text.begin(), text.end(), small.begin(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

// Bytes as text has them: %20 and the like undone.
std::vector<uint8_t> bytesOf(std::string_view text) {
  const std::string decoded = percentDecoded(text);
  return {decoded.begin(), decoded.end()};
}

}  // namespace

bool isDataUri(std::string_view uri) {
  return equalsInSmall(schemeOf(uri), "data");
}

bool isRemoteUri(std::string_view uri) {
  return equalsInSmall(schemeOf(uri), "http") || equalsInSmall(schemeOf(uri), "https");
}

std::vector<uint8_t> decodeDataUri(std::string_view uri, const std::string& jsonPath) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos)
    fail(jsonPath, "is a data URI without data", "export the scene with base64 data or a .bin file");
  // RFC 2397: the last of the words between semicolons says how bytes are written.
  std::string_view type = uri.substr(0, comma);
  while (!type.empty() && isSpace(type.back())) type.remove_suffix(1);
  std::string_view text = uri.substr(comma + 1);
  const size_t semicolon = type.rfind(';');
  std::string_view last = semicolon == type.npos ? std::string_view() : type.substr(semicolon + 1);
  while (!last.empty() && isSpace(last.front())) last.remove_prefix(1);
  if (!equalsInSmall(last, "base64")) return bytesOf(text);
  // Some writers percent-encode what base64 has of signs.
  std::string decoded;
  if (text.find('%') != text.npos) text = decoded = percentDecoded(text);

  std::vector<uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int bitCount = 0;
  bool hasEnded = false;
  for (const char c : text) {
    if (isSpace(c)) continue;  // lines are broken
    hasEnded |= c == '=';
    if (c == '=') continue;
    if (hasEnded) fail(jsonPath, "holds base64 that goes on after its end", "export the scene again");
    const int8_t digit = kBase64[static_cast<unsigned char>(c)];
    if (digit < 0) fail(jsonPath, "holds base64 with a letter that is none", "export the scene again");
    bits = (bits << 6 | static_cast<uint32_t>(digit)) & 0xffffff;
    bitCount += 6;
    if (bitCount >= 8) {
      bitCount -= 8;
      bytes.push_back(static_cast<uint8_t>(bits >> bitCount));
    }
  }
  return bytes;
}

std::string resolveFileUri(std::string_view uri, const std::string& folder, bool allowOutside,
                           const std::string& jsonPath) {
  if (const std::string_view scheme = schemeOf(uri); !scheme.empty())
    fail(jsonPath,
         "points to \"" + shortened(uri) + "\", and scumble never uses the network or other schemes",
         "put the file beside the scene and name it by a relative path");
  // Programs on Windows write its separators, and servers' addresses go on with a query. But where there is a
  // file that is called just so, that is meant.
  std::string path = percentDecoded(withoutQuery(uri));
  std::replace(path.begin(), path.end(), '\\', '/');
  if (const std::string literal = percentDecoded(uri); literal != path && isInside(literal)) {
    std::error_code failed;
    if (!folder.empty() && literal.find('\0') == std::string::npos &&
        std::filesystem::is_regular_file(std::filesystem::path(folder) / literal, failed))
      path = literal;
  }
  if (path.empty() || path.find('\0') != std::string::npos)
    fail(jsonPath, "is not a usable path: \"" + shortened(uri) + "\"");
  if (folder.empty())
    fail(jsonPath,
         "names the file \"" + shortened(path) + "\", but this scene comes from memory and has no folder",
         "use a .glb that holds everything");
  if (!isInside(path) && !allowOutside)
    fail(jsonPath, "leads out of the scene's folder: \"" + shortened(path) + "\"",
         "move the file into the folder, or give --allow-outside");
  return (std::filesystem::path(folder) / std::filesystem::path(path).lexically_normal()).string();
}

}  // namespace scumble::gltf
