/* SCUMBLE_API: what the shared library shows to others. C and C++. */
#ifndef SCUMBLE_EXPORT_H
#define SCUMBLE_EXPORT_H

#define SCUMBLE_API __attribute__((visibility("default")))

#endif
