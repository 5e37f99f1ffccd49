# SPDX-License-Identifier: GPL-3.0-or-later
"""Scumble in Blender: an engine that paints, looks as panels, colorizers as empties.

Runs `scumble serve`, another process, and speaks its protocol.
"""
bl_info = {
    "name": "Scumble",
    "author": "The scumble authors",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > Render Engine",
    "description": "Moving paintings: an engine, looks as panels, colorizers as empties",
    "category": "Render",
}

import bpy  # noqa: E402  (Blender reads bl_info first)

from . import engine, interface, settings  # noqa: E402


def register():
    settings.register()
    bpy.utils.register_class(engine.ScumbleEngine)
    interface.register()


def unregister():
    interface.unregister()
    bpy.utils.unregister_class(engine.ScumbleEngine)
    settings.unregister()
    engine.close_all()
