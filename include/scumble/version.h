/* The version that these headers are of. Until 1.0, a library fits headers of the same MAJOR.MINOR; the
   shared library's soname says so. C and C++. */
#ifndef SCUMBLE_VERSION_H
#define SCUMBLE_VERSION_H

#define SCUMBLE_VERSION_MAJOR 0
#define SCUMBLE_VERSION_MINOR 1
#define SCUMBLE_VERSION_PATCH 0
#define SCUMBLE_VERSION_STRING "0.1.0"

#endif
