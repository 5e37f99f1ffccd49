// Looks: art direction as one JSON file that sets knobs. `scumble params` lists the knobs, `scumble schema`
// prints the file's JSON schema.
//
//   { "description": "Low sun, torn edges.",
//     "shadow": { "threshold": { "keys": [[0, 0.4], [2.5, 0.6]] } },
//     "materials": { "Sail*": { "warp": { "amount": 2 } } } }
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scumble/export.h"
#include "scumble/result.h"

namespace scumble {

namespace look {
struct LookData;
}

struct ShippedLook {
  std::string name, description;
};

// A knob as `scumble params` shows it; numbers as text in the form that set() reads.
struct Knob {
  std::string path, type, defaultValue, min, max, unit, meaning;
  // What it may be set for: "scene" by its path alone; "materials", "nodes" and "clips" for those whose names
  // match a pattern, as in "materials.PATTERN." + path; "colorizers" and "decorations" for those that looks
  // declare by a name.
  std::vector<std::string> targets;
};

// A knob's value: a toggle's is bool, an integer's int, a number's double, a colour's linear RGB from 0 to 1,
// a vector's itself, and a word for choices, pictures (built in, or a file's path) and names.
using KnobValue = std::variant<bool, int, double, glm::vec3, std::string>;

// How a knob goes from one key to the next: it stands, goes straight, smoothly through all keys, or smoothly
// with rests at the ends and where values turn (docs/looks.md).
enum class Interpolation : uint8_t { step, linear, cubic, ease };

// A knob's value that changes with time.
struct KnobTrack {
  struct Key {
    double time = 0;  // seconds, a billion at most
    KnobValue value;
  };
  std::vector<Key> keys;                                // 1 to 100,000; their times strictly increase
  Interpolation interpolation = Interpolation::linear;  // `step` alone for what nothing lies between
  bool repeat = false;  // with the period last - first key's time; otherwise the ends' values stand
};

// Whether Look::load takes this for a file (it has a '/', or ends in .json), or for the name of one that
// ships.
SCUMBLE_API bool isLookFile(const std::string& nameOrFile);

// Whether a text is a colour as knobs take them: "#RRGGBB", "#RGB", or one of CSS's names in small letters.
SCUMBLE_API bool isColor(const std::string& text);

// Values for knobs; what is not set has its default. Copies are cheap. Several threads may read a look at
// once; who changes one (set, unset, assignment) is alone with that copy.
class SCUMBLE_API Look {
 public:
  Look();  // all defaults

  // A look that ships (by name), or a JSON file (by a path with '/' or ending in .json). Fails with
  // unusableFile for files and with usage for unknown names. A look may extend another one ("extends"): that
  // one's settings come before its own. JSON with comments is taken.
  static Result<Look> load(const std::string& nameOrFile);
  static Result<Look> fromJson(const std::string& text, const std::string& file);

  // Sets one knob, e.g. ("shadow.threshold", 0.4) or ("materials.Sail*.warp.amount", 2), likewise below
  // "nodes" and "clips"; below "colorizers" and "decorations" a new name declares one. Any knob takes its
  // value as text, too: "0.4", "true", "#EADFC8", "1,2,3", and a track as looks' files have it,
  // "{\"keys\": [[0, 0.4], [2.5, 0.6]]}". It wins over the file's values and tracks; a
  // setting for some names wins over one for the whole scene; of two alike the later one wins. Fails with
  // ErrorKind::usage, and with unusableFile for pictures.
  Status set(const std::string& path, const KnobValue& value);
  Status set(const std::string& path, const KnobTrack& track);
  // Takes back what set() has set by this very path: what the file says holds again. Fails with
  // ErrorKind::usage where there is no such knob.
  Status unset(const std::string& path);
  // What holds at a time (seconds) for the whole scene, or for one name of a section
  // ("materials.Sail.warp.amount"; of a node what the look says for the scene and for nodes of its name).
  // Fails with ErrorKind::usage where there is no such knob, and for patterns, which have no one value.
  Result<KnobValue> get(const std::string& path, double time = 0) const;
  // What get() follows as time goes on; nothing where a value holds for ever. Fails as get() does.
  Result<std::optional<KnobTrack>> track(const std::string& path) const;

  // Settings with tracks by their paths, as set() takes them, each once, in no order; those for patterns of
  // names too, and those that a value by hand wins over (track() tells).
  std::vector<std::string> animated() const;
  // Seconds of the last key of all of them; 0 where there is none later.
  double lastKeyTime() const;
  // The names that it declares below "colorizers" or "decorations", in their order; of other sections those
  // for which it sets something, patterns apart.
  std::vector<std::string> names(const std::string& section) const;

  const std::string& description() const;
  // Files that it was read from: looks, those that it extends too, and pictures.
  std::vector<std::string> files() const;
  // What the file says to no effect, each a line with its place: keys that stand twice.
  const std::vector<std::string>& warnings() const;

  static std::vector<ShippedLook> shipped();
  static std::vector<Knob> knobs();
  static std::string jsonSchema();

  // For the library's own rooms.
  const look::LookData& data() const { return *data_; }

 private:
  std::shared_ptr<const look::LookData> data_;
};

}  // namespace scumble
