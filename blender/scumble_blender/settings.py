# SPDX-License-Identifier: GPL-3.0-or-later
"""What is set in Blender for scumble: properties of scenes, layers, materials and objects, made from the schema.

Knobs are properties, so they take keys and drivers like all others; those that nobody has set are the look's.
"""
import os
import shutil

import bpy
import numpy as np
from bpy.props import (BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty,
                       StringProperty)

from . import blender, knobs, space
from .cryptomatte import murmur3

# What can be had beside the picture: AOVs of scumble, and what Blender's layers call them.
PASSES = {
    "depth": ("Depth", 1, "Z", "VALUE"),
    "motion": ("Vector", 4, "XYZW", "VECTOR"),
    "cryptomatte": ("CryptoObject", 8, "RGBA", "COLOR"),
    "position": ("Position", 3, "XYZ", "VECTOR"),
    "normal": ("Normal", 3, "XYZ", "VECTOR"),
    "uv": ("UV", 3, "UVA", "VECTOR"),
    **{name: (name, 4, "RGBA", "COLOR") for name in (
        "warp", "shadow", "lit", "shadowed", "final-shadow", "color", "colorize", "limit", "final-color", "blur",
        "pigment", "ink", "uv-gradient", "metatexture")},
}

KNOBS = {}  # by section, from the schema
LOOKS = []  # names and descriptions of those that ship
PROBLEM = ""  # why there are none


def program():
    """Where scumble is."""
    addon = bpy.context.preferences.addons.get(__package__)
    named = addon.preferences.program if addon else ""
    return named or os.environ.get("SCUMBLE") or shutil.which("scumble") or "scumble"


def arguments():
    addon = bpy.context.preferences.addons.get(__package__)
    return ["--device", addon.preferences.device] if addon and addon.preferences.device else []


def _items(words):
    """For an EnumProperty. Files keep numbers, which must stay where words come between."""
    return [(word, word, meaning, murmur3(word) & 0x3FFFFFFF) for word, meaning in words]


def _changed(group, _context):
    """Has what is evaluated know of it, and so viewports."""
    group.id_data.update_tag()


def _property(knob):
    common = {"name": knob.label, "description": knob.meaning, "update": _changed}
    if knob.kind == "toggle":
        return BoolProperty(default=knob.default, **common)
    if knob.kind == "whole":
        return IntProperty(default=int(knob.default), min=int(knob.least), max=int(knob.most), **common)
    if knob.kind == "number":
        return FloatProperty(default=knob.default, min=knob.least, max=knob.most, precision=3, **common)
    if knob.kind == "vector":
        return FloatVectorProperty(default=knob.default, min=knob.least, max=knob.most, size=3, **common)
    if knob.kind == "color":
        codes = [int(knob.default[i:i + 2], 16) / 255 for i in (1, 3, 5)]
        return FloatVectorProperty(default=codes, min=0, max=1, size=3, subtype="COLOR_GAMMA", **common)
    if knob.kind == "choice":
        return EnumProperty(items=_items([(word, "") for word in knob.choices]), default=knob.default, **common)
    return StringProperty(default=str(knob.default or ""), **common)


def _group(name, section):
    return type(name, (bpy.types.PropertyGroup,),
                {"__annotations__": {knob.name: _property(knob) for knob in KNOBS.get(section, ())}})


def _part(owner, *names):
    """A group within groups, or None where nothing in it is set: asking for it would make it, and what has been
    evaluated is not ours to add to."""
    for name in names:
        if owner is None or not owner.is_property_set(name):
            return None
        owner = getattr(owner, name)
    return owner


def values_of(group, section):
    """What is set in a group of knobs, as the protocol takes it, by paths."""
    if group is None:
        return {}
    return {knob.path: knob.text(getattr(group, knob.name)) for knob in KNOBS.get(section, ())
            if group.is_property_set(knob.name)}


def look_of(scene):
    """The base of a scene's look: its name or file, with what tells whether the file has changed."""
    settings = _part(scene, "scumble")
    if settings is None:
        return ("",)
    name = settings.look
    if settings.look_file:
        name = os.path.abspath(bpy.path.abspath(settings.look_file))
        if not name.endswith(".json"):
            return (name + "/",)
        try:
            return (name, os.stat(name).st_mtime_ns)
        except OSError:
            return (name,)
    return (name,)


def knobs_of(depsgraph, empties):
    """All that is set, of an evaluated scene: for the scene, by materials, by objects, and by empties; and notes of
    what cannot be."""
    scene = depsgraph.scene
    found = values_of(_part(scene, "scumble", "knobs"), "scene")
    names, notes = set(), []

    def add(section, name, values):
        if values and any(letter in name for letter in "*?"):
            notes.append(f"'{name}' has a '*' or '?' in its name, which stand for any letters in looks: what is set "
                         "for it alone is left out")
        else:
            found.update({f"{section}.{name}.{path}": value for path, value in values.items()})

    for instance in depsgraph.object_instances:
        evaluated = instance.object
        if evaluated.name in names:
            continue
        names.add(evaluated.name)
        settings = _part(evaluated, "scumble")
        if settings is not None and settings.is_ocean:
            found.update(values_of(_part(settings, "ocean"), "ocean"))
        add("nodes", evaluated.name, values_of(_part(settings, "knobs"), "nodes"))
        # Blender 3.4 ends where an evaluated empty is asked for its materials.
        for slot in evaluated.material_slots if evaluated.type in blender.PAINTED else ():
            if slot.material is not None:
                add("materials", slot.material.name, values_of(_part(slot.material, "scumble", "knobs"), "materials"))
    for original, world in empties:
        settings = _part(original.evaluated_get(depsgraph), "scumble")
        if settings is None:
            continue
        if settings.is_colorizer:
            add("colorizers", original.name, {**_place_of_volume(original, world),
                                              **values_of(_part(settings, "colorizer"), "colorizers")})
        if settings.is_decoration:
            at = space.vectors(world[None, :3, 3])[0]
            add("decorations", original.name, {"water.at": [float(x) for x in at],
                                               **values_of(_part(settings, "decoration"), "decorations")})
    return found, list(dict.fromkeys(notes))


def _place_of_volume(empty, world):
    """An empty's place, turn, size and kind as a volume's; what is set by hand wins."""
    turned = space.matrix(world)
    scales = np.maximum(np.linalg.norm(turned[:3, :3], axis=0), 1e-9)
    half = [float(min(max(x, 1e-3), 1e5)) for x in scales * empty.empty_display_size]
    is_even = max(half) <= 1.001 * min(half)
    shapes = {"CUBE": "box", "CIRCLE": "half-space", "SINGLE_ARROW": "half-space"}
    shape = shapes.get(empty.empty_display_type, "sphere" if is_even else "ellipsoid")
    return {"volume.shape": shape,
            "volume.center": [float(x) for x in turned[:3, 3]],
            "volume.rotation": space.degrees_about_x_y_z(turned[:3, :3] / scales),
            "volume.size": half,
            "volume.radius": max(half)}


def pass_property(aov):
    """Of a layer's settings."""
    return "pass_" + aov.replace("-", "_")


def passes_of(view_layer):
    """AOVs that a layer has."""
    return [aov for aov in PASSES if getattr(view_layer.scumble, pass_property(aov))]


class ScumbleAddonPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: StringProperty(name="Program", subtype="FILE_PATH",
                            description="Where scumble is; empty: where the system finds it")
    device: StringProperty(name="Device",
                           description="A GPU by name or number, cpu, or gpu for any other; empty: the best one")

    def draw(self, context):
        self.layout.prop(self, "program")
        self.layout.prop(self, "device")
        if PROBLEM:
            self.layout.label(text=PROBLEM, icon="ERROR")
            self.layout.label(text="Set the program, save the preferences, and enable the add-on anew.")


_classes = []


def register():
    global PROBLEM
    KNOBS.clear()
    bpy.utils.register_class(ScumbleAddonPreferences)
    try:
        KNOBS.update(knobs.ask(program()))
        LOOKS[:] = knobs.looks(program())
        PROBLEM = ""
    except Exception as error:  # whatever program this is: the preferences must be there to name another one
        PROBLEM = f"'{program()}' gives no knobs: {error}"
        print(f"scumble: {PROBLEM}")
    KNOBS["ocean"] = [knob for knob in KNOBS.get("scene", ()) if knob.path.startswith("ocean.")]

    scene_knobs, ocean_knobs = _group("ScumbleKnobs", "scene"), _group("ScumbleOceanKnobs", "ocean")
    material_knobs, node_knobs = _group("ScumbleMaterialKnobs", "materials"), _group("ScumbleObjectKnobs", "nodes")
    colorizer_knobs = _group("ScumbleColorizerKnobs", "colorizers")
    decoration_knobs = _group("ScumbleDecorationKnobs", "decorations")

    def settings(name, **properties):
        return type(name, (bpy.types.PropertyGroup,), {"__annotations__": properties})

    of_scene = settings(
        "ScumbleSceneSettings",
        look=EnumProperty(update=_changed, name="Look", items=_items(LOOKS or [("age-of-sail", "")]),
                          default="age-of-sail", description="A look that ships with scumble"),
        look_file=StringProperty(update=_changed, name="Look file", subtype="FILE_PATH",
                                 description="A look of your own, in its place"),
        samples=EnumProperty(update=_changed, name="Samples", default="4",
                             items=[("1", "1", "Fast"), ("4", "4", "Smooth edges")]),
        seed=IntProperty(update=_changed, name="Seed", min=0, description="Moves every pattern"),
        knobs=PointerProperty(type=scene_knobs))
    of_layer = settings("ScumbleLayerSettings", **{
        pass_property(aov): BoolProperty(name=name if name == aov else f"{name} ({aov})")
        for aov, (name, *_) in PASSES.items()})
    of_material = settings("ScumbleMaterialSettings", knobs=PointerProperty(type=material_knobs))
    of_object = settings(
        "ScumbleObjectSettings",
        knobs=PointerProperty(type=node_knobs),
        is_ocean=BoolProperty(update=_changed, name="Ocean",
                              description="The sea is here, at this height and in place of the mesh"),
        ocean=PointerProperty(type=ocean_knobs),
        is_colorizer=BoolProperty(update=_changed, name="Colorizer",
                                  description="This empty grades the colours of what is in it"),
        colorizer=PointerProperty(type=colorizer_knobs),
        is_decoration=BoolProperty(update=_changed, name="Wake, ripples or splash",
                                   description="This empty decorates the water"),
        decoration=PointerProperty(type=decoration_knobs))
    _classes.extend([scene_knobs, ocean_knobs, material_knobs, node_knobs, colorizer_knobs,
                     decoration_knobs, of_scene, of_layer, of_material, of_object])
    for each in _classes:
        bpy.utils.register_class(each)
    bpy.types.Scene.scumble = PointerProperty(type=of_scene)
    bpy.types.ViewLayer.scumble = PointerProperty(type=of_layer)
    bpy.types.Material.scumble = PointerProperty(type=of_material)
    bpy.types.Object.scumble = PointerProperty(type=of_object)


def unregister():
    for owner in (bpy.types.Scene, bpy.types.ViewLayer, bpy.types.Material, bpy.types.Object):
        del owner.scumble
    for each in reversed(_classes):
        bpy.utils.unregister_class(each)
    _classes.clear()
    bpy.utils.unregister_class(ScumbleAddonPreferences)
