/* The version that these headers are of. A shared library fits programs that were compiled with headers of
   the same MAJOR and of a MINOR that is not newer; its soname carries MAJOR. C and C++. */
#ifndef SCUMBLE_VERSION_H
#define SCUMBLE_VERSION_H

#define SCUMBLE_VERSION_MAJOR 1
#define SCUMBLE_VERSION_MINOR 0
#define SCUMBLE_VERSION_PATCH 0
#define SCUMBLE_VERSION_STRING "1.0.0"

#endif
