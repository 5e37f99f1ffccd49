/* SCUMBLE_API: what the shared library shows to others; SCUMBLE_HIDDEN: a part of that which it does not. C
   and C++. */
#ifndef SCUMBLE_EXPORT_H
#define SCUMBLE_EXPORT_H

#define SCUMBLE_API __attribute__((visibility("default")))
#define SCUMBLE_HIDDEN __attribute__((visibility("hidden")))

#endif
