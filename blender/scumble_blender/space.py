# SPDX-License-Identifier: GPL-3.0-or-later
"""From Blender's space (z up) to scumble's and glTF's (y up), and its projections to Vulkan's."""
import math

import numpy as np

from .server import ScumbleError

# x, y, z become x, z, -y.
TO_Y_UP = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], np.float64)


def vectors(rows):
    """n by 3: positions or normals."""
    turned = np.empty_like(rows)
    turned[:, 0], turned[:, 1], turned[:, 2] = rows[:, 0], rows[:, 2], -rows[:, 1]
    return turned


def matrix(blender):
    """A transform of what has vertices, whose own space is turned as well."""
    return TO_Y_UP @ np.array(blender, np.float64) @ TO_Y_UP.T


def matrix_of_looking(blender):
    """Of lamps and cameras, which look along -z in both."""
    return TO_Y_UP @ np.array(blender, np.float64)


def without_scale(transform):
    result = np.array(transform, np.float64)
    for axis in range(3):
        length = np.linalg.norm(result[:3, axis])
        if length > 0:
            result[:3, axis] /= length
    return result


def columns(transform):
    """As the protocol has it."""
    return [float(x) for x in np.asarray(transform, np.float64).T.reshape(-1)]


def inverse(transform):
    """None of what is flat."""
    try:
        inverted = np.linalg.inv(transform)
    except np.linalg.LinAlgError:
        return None
    return inverted if np.all(np.isfinite(inverted)) else None


def projection(opengl, near=None):
    """Vulkan's (y down, depth reversed, without a far plane in perspective) from OpenGL's."""
    given = np.array(opengl, np.float64)
    result = given.copy()
    result[1] = -given[1]
    is_perspective = given[3][2] != 0
    if is_perspective:
        if near is None:
            near = given[2][3] / (given[2][2] - 1)
        result[2] = [0, 0, 0, near]
    else:
        result[2] = (given[3] - given[2]) / 2
    return result


def view(camera_to_world, eye_to_clip, node=None):
    """One for the protocol; the camera's place is one of scumble's space, without scale."""
    to_eye = inverse(camera_to_world)
    if to_eye is None:
        raise ScumbleError("the camera is scaled to nothing, or lies nowhere")
    described = {"worldToEye": columns(to_eye), "eyeToClip": columns(eye_to_clip)}
    if node is not None:
        described["node"] = node
    return described


def degrees_about_x_y_z(rotation):
    """Of a 3 by 3 rotation that turns about x first and about z last."""
    y = math.asin(max(-1.0, min(1.0, -rotation[2][0])))
    if abs(rotation[2][0]) < 1 - 1e-9:
        x, z = math.atan2(rotation[2][1], rotation[2][2]), math.atan2(rotation[1][0], rotation[0][0])
    else:
        x, z = math.atan2(-rotation[1][2], rotation[1][1]), 0.0
    return [math.degrees(angle) for angle in (x, y, z)]


def vectors_back(picture):
    """Rows by columns by 3, from y up to z up."""
    return np.stack([picture[..., 0], -picture[..., 2], picture[..., 1]], axis=-1)
