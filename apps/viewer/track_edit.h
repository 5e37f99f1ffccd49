// Tracks of knobs, as hands make and change them. Times in seconds.
#pragma once

#include <optional>
#include <string>

#include "document.h"

namespace scumble::viewer {

// By Interpolation, as looks call them; and whether a knob takes others than the first.
inline constexpr const char* kInterpolations[] = {"step", "linear", "cubic", "ease"};
bool isSmooth(const Knob& knob);

// What a look says of a track, as Look::set takes it: { "keys": [[0, 0.4], [2.5, 0.6]] }. Nothing where a
// word in it is no UTF-8, as files' names may be: JSON has no place for it.
std::optional<std::string> textOf(const KnobTrack& track, const Knob& knob);
// Why a setting has no track then.
Error noTrackOf(const std::string& path);

// Whether a setting's text is a track, whatever is in it.
bool isTrackText(const std::string& text);

// What keys are set to lies on a grid this fine, and never after the time that was asked for: a step has been
// taken then. Keys that hands make are farther apart than kNearKey.
constexpr double kKeysPerSecond = 10000, kNearKey = 0.01;
double onKeyGrid(double time);
// The key that is nearest to a time, within that, by its number.
std::optional<size_t> keyAt(const KnobTrack& track, double time);
// Where there is one at that time, it gets the value.
void putKey(KnobTrack& track, double time, const KnobValue& value);
// Goes to that time, or as near to it as its neighbours let it. Gives where it is then.
double moveKey(KnobTrack& track, size_t key, double time);

// What a setting (text) becomes where a hand turns it to a value at a time: that, or a track with a key more
// where it has a track already. Nothing where it is no value, or there can be no such track.
std::optional<std::string> turnedAt(const Look& look, const std::string& path, const std::string& value,
                                    double time);
// With a key at a time more, or where there is one, with that one less; the last one leaves a value.
std::optional<std::string> keyToggledAt(const Look& look, const std::string& path, double time);
// With a key of that value more; where there is no track yet, it begins with that key.
std::optional<std::string> keyedAt(const Look& look, const std::string& path, const KnobValue& value,
                                   double time, Interpolation interpolation);

}  // namespace scumble::viewer
