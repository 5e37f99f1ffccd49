// How far something is that takes a while, and a way to stop it.
#pragma once

#include <functional>

namespace scumble {

// Called now and then with the part that is done, from 0 to 1 and never less than before; returns whether to
// go on. Where it does not, the call fails with ErrorKind::cancelled, and nothing has changed. It may come
// from a thread of the library's own, from one at a time; it does not call back what is being done.
using Progress = std::function<bool(double part)>;

}  // namespace scumble
