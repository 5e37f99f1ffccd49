# SPDX-License-Identifier: GPL-3.0-or-later
"""From a mesh whose faces' corners have normals, coordinates and colours to vertices, a part a material. Knows
nothing of Blender."""
import numpy as np

_MIX = np.uint64(0x9E3779B97F4A7C15)


def _distinct(rows):
    """Of an array of 32-bit words, n by k: the first of each distinct row, and which of them each one is."""
    hashed = np.zeros(len(rows), np.uint64)
    for column in range(rows.shape[1]):
        hashed = (hashed ^ rows[:, column]) * _MIX
        hashed ^= hashed >> np.uint64(29)
    _, first, which = np.unique(hashed, return_index=True, return_inverse=True)
    if np.array_equal(rows[first][which], rows):
        return first, which
    _, first, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return first, which.reshape(-1)


def parts(corners, positions, triangles, material_of_triangle, materials):
    """Parts of a mesh as Description has them.

    corners: dict with "vertex" (n, the number of each corner's vertex), and arrays of n rows: normals, uv0, uv1
    (n by 2), colors (n by 4, uint8), warpScales, roundness (n); absent ones are not there.
    positions: vertices by 3. triangles: m by 3 numbers of corners. materials: keys by their numbers.
    """
    names = [name for name in corners if name != "vertex"]
    columns = [corners["vertex"].astype(np.uint32)[:, None]]
    for name in names:
        array = np.ascontiguousarray(corners[name])
        # One zero, so that vertices are not told apart by its sign.
        if array.dtype == np.float32:
            array = array + np.float32(0)
        columns.append(array.view(np.uint32).reshape(len(array), -1))
    first, which = _distinct(np.concatenate(columns, axis=1))
    vertex_of_triangle = which[triangles]
    found = []
    last = max(len(materials) - 1, 0)
    material_of_triangle = np.clip(material_of_triangle, 0, last)
    for number in np.unique(material_of_triangle):
        own = vertex_of_triangle[material_of_triangle == number]
        used, indices = np.unique(own, return_inverse=True)
        corner = first[used]
        part = {"material": materials[number] if materials else "",
                "positions": np.ascontiguousarray(positions[corners["vertex"][corner]]),
                "indices": indices.reshape(-1).astype(np.uint32)}
        for name in names:
            part[name] = np.ascontiguousarray(corners[name][corner])
        found.append(part)
    return found
