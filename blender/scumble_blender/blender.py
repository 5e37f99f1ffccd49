# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read from Blender: its scene as plain descriptions. Nothing here writes to it.

Differences between versions are handled here, and nowhere else:
- normals of corners: `calc_normals_split` and `loops` up to 4.0, `corner_normals` from 4.1 on;
- emission of the Principled BSDF: socket "Emission" up to 3.x, "Emission Color" from 4.0 on;
- transparency: `blend_method` up to 4.1; from 4.2 on it has only "HASHED" or "BLEND" in `surface_render_method`,
  and what has no alpha is opaque either way;
- colour attributes: `color_attributes` from 3.2 on, which is the oldest that is read;
- `bind_display_space_shader` is absent where viewports manage colours alone.
Tested in 3.4; the others by their documentation.
"""
import math
import os

import bpy
import numpy as np

from . import meshes, space
from .mirror import Description

PAINTED = ("MESH", "CURVE", "SURFACE", "META", "FONT")  # objects that have surfaces
DEEPEST = 20  # nodes behind one another, which may lead in circles
WATTS_TO_LUMENS = 683  # as Blender's glTF exporter has it


def number(value, least=0.0, most=1e30):
    """Within what scumble takes, also where it is none."""
    value = float(value)
    return min(max(value, least), most) if math.isfinite(value) else least


def unit(values):
    return [number(value, 0.0, 1.0) for value in values]


class Notes:
    """What could not be taken over, each kind once."""

    def __init__(self):
        self.lines = []

    def add(self, line):
        if line not in self.lines:
            self.lines.append(line)


# -- Pictures


class Images:
    """Pixels of images, read again only where an image has changed."""

    def __init__(self):
        self._seen = {}

    def fingerprint(self, image):
        path = bpy.path.abspath(image.filepath, library=image.library) if image.filepath else ""
        try:
            state = os.stat(path)
            file = (path, state.st_mtime_ns, state.st_size)
        except OSError:
            file = (path,)
        return (image.name_full, tuple(image.size), image.colorspace_settings.name, image.source,
                tuple(image.generated_color), image.generated_type, bool(image.packed_file), file)

    def key(self, image, description, is_known, notes):
        """Its key, with its pixels in the description; None where it has none."""
        if image is not None and image.source in ("SEQUENCE", "MOVIE", "TILED"):
            notes.add(f"the image '{image.name}' is a {image.source.lower()}, which is not taken over")
            return None
        if image is None or 0 in image.size[:]:
            notes.add(f"the image '{image.name if image else ''}' has no pixels")
            return None
        key = "image/" + image.name_full
        if key in description.textures:
            return key
        fingerprint = self.fingerprint(image)
        if not image.is_dirty and self._seen.get(key) == fingerprint and is_known("textures", key):
            description.textures[key] = None
            return key
        width, height = image.size
        pixels = np.empty(width * height * 4, np.float32)
        image.pixels.foreach_get(pixels)
        pixels = pixels.reshape(height, width, 4)
        if image.is_float:
            pixels[..., :3] = srgb(pixels[..., :3])
        codes = np.rint(np.clip(np.nan_to_num(pixels), 0, 1) * 255).astype(np.uint8)
        description.textures[key] = {"width": width, "height": height,
                                     "rgba": np.ascontiguousarray(codes[::-1]).reshape(-1)}
        self._seen[key] = fingerprint
        return key


def srgb(linear):
    clipped = np.maximum(linear, 0)
    return np.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * np.power(clipped, 1 / 2.4) - 0.055)


# -- Materials


def _slot(node, key, layers):
    """A texture node as a slot, with what stands before its coordinates. layers: names of UV maps, in their order."""
    slot = {"texture": key}
    wraps = {"REPEAT": "repeat", "MIRROR": "mirrored-repeat"}
    slot["wrapU"] = slot["wrapV"] = wraps.get(node.extension, "clamp-to-edge")
    if node.interpolation == "Closest":
        slot["nearest"] = True
    before = _before(node.inputs["Vector"])
    if before is not None and before.type == "MAPPING":
        mapping = before
        move, turn, scale = (mapping.inputs[name].default_value for name in ("Location", "Rotation", "Scale"))
        sine, cosine = math.sin(turn[2]), math.cos(turn[2])
        # Blender's coordinates grow upwards, glTF's downwards: v' = 1 - v on both sides.
        matrix = np.array([[cosine * scale[0], -sine * scale[1], move[0]],
                           [sine * scale[0], cosine * scale[1], move[1]], [0, 0, 1]])
        flip = np.array([[1, 0, 0], [0, -1, 1], [0, 0, 1]])
        slot["transform"] = [float(x) for x in (flip @ matrix @ flip).T.reshape(-1)]
        before = _before(mapping.inputs["Vector"])
    if before is not None and before.type == "UVMAP":
        name = before.uv_map
        if name in layers[1:2]:
            slot["uvSet"] = 1
    return slot


class _Materials:
    def __init__(self, images, description, is_known, notes):
        self.images, self.description, self.is_known, self.notes = images, description, is_known, notes

    def _texture(self, node):
        key = self.images.key(node.image, self.description, self.is_known, self.notes)
        return _slot(node, key, self.layers) if key else None

    def _read(self, socket, material, depth=0):
        """What a colour's socket comes to: a factor, and a texture or None."""
        value = list(socket.default_value) if hasattr(socket.default_value, "__len__") else [socket.default_value] * 3
        if not socket.is_linked:
            return value, None
        node = _before(socket)
        if node is None or depth > DEEPEST:
            return value, None
        if node.type == "TEX_IMAGE":
            return [1.0, 1.0, 1.0, 1.0], self._texture(node)
        if node.type == "RGB":
            return list(node.outputs[0].default_value), None
        if node.type in ("VERTEX_COLOR", "ATTRIBUTE"):
            return [1.0, 1.0, 1.0, 1.0], None
        if node.type in ("MIX_RGB", "MIX") and node.blend_type == "MULTIPLY":
            inputs = [each for each in node.inputs if each.type == "RGBA" and each.enabled]
            factor, texture = [1.0, 1.0, 1.0, 1.0], None
            for each in inputs[:2]:
                inner, inner_texture = self._read(each, material, depth + 1)
                factor = [a * b for a, b in zip(factor, inner)]
                texture = texture or inner_texture
            return factor, texture
        self.notes.add(f"material '{material.name}': '{node.name}' is not taken over as a colour")
        return value, None

    def describe(self, material, layers):
        """layers: names of the UV maps of a mesh that has it."""
        self.layers = layers
        described = {"name": material.name, "doubleSided": not material.use_backface_culling}
        color, texture, alpha = list(material.diffuse_color), None, 1.0
        surface = _surface(material)
        if surface is None:
            alpha = color[3]
        elif surface.type == "BSDF_PRINCIPLED":
            color, texture = self._read(surface.inputs["Base Color"], material)
            glow_name = "Emission Color" if "Emission Color" in surface.inputs else "Emission"
            glow, glow_texture = self._read(surface.inputs[glow_name], material)
            strength = surface.inputs["Emission Strength"].default_value
            if strength > 0 and (any(c > 0 for c in glow[:3])):
                described["emissive"] = [number(c * strength) for c in glow[:3]]
                if glow_texture:
                    described["emissiveTexture"] = glow_texture
            opacity = surface.inputs["Alpha"]
            alpha = 1.0 if opacity.is_linked else opacity.default_value
        elif surface.type in ("EMISSION", "BACKGROUND"):
            color, texture = self._read(surface.inputs["Color"], material)
            described["unlit"] = True
        elif "Color" in surface.inputs:
            color, texture = self._read(surface.inputs["Color"], material)
        else:
            self.notes.add(f"material '{material.name}': its shader '{surface.name}' is drawn as plain paint")
        described["baseColor"] = unit([*color[:3], alpha])
        if texture:
            described["baseColorTexture"] = texture
        described.update(_alpha(material, surface, alpha))
        described.update(self._mtoon(material))
        return described

    def _mtoon(self, material):
        """Outlines as the VRM add-on has them, version 1 of MToon."""
        mtoon = getattr(getattr(material, "vrm_addon_extension", None), "mtoon1", None)
        if mtoon is None or not getattr(mtoon, "enabled", False):
            return {}
        described = {}
        pbr = getattr(mtoon, "pbr_metallic_roughness", None)
        if pbr is not None:
            described["baseColor"] = unit(pbr.base_color_factor)
        extension = mtoon.extensions.vrmc_materials_mtoon
        mode = extension.outline_width_mode
        if mode != "none":
            described["outline"] = {
                "unit": "picture-heights" if mode == "screenCoordinates" else "metres",
                "width": number(extension.outline_width_factor, 0.0, 1000.0),
                "color": unit(extension.outline_color_factor),
                "lightingMix": number(extension.outline_lighting_mix_factor, 0.0, 1.0)}
        return described


def _before(socket):
    """The node that gives a socket its value, past reroutes; None where none does."""
    for _ in range(DEEPEST):
        if not socket.is_linked:
            return None
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return node
        socket = node.inputs[0]
    return None


def _surface(material):
    if not material.use_nodes or not material.node_tree:
        return None
    outputs = [node for node in material.node_tree.nodes if node.type == "OUTPUT_MATERIAL"]
    output = next((node for node in outputs if node.is_active_output), outputs[0] if outputs else None)
    return _before(output.inputs["Surface"]) if output is not None else None


def _alpha(material, surface, alpha):
    is_linked = surface is not None and "Alpha" in surface.inputs and surface.inputs["Alpha"].is_linked
    if not is_linked and alpha >= 1:
        return {}
    method = getattr(material, "blend_method", None)
    if method == "CLIP":
        return {"alpha": "mask", "alphaCutoff": float(material.alpha_threshold)}
    if method == "HASHED" and is_linked:
        return {"alpha": "mask", "alphaCutoff": 0.5}
    return {} if method == "OPAQUE" else {"alpha": "blend"}


def _uses_colors(material):
    if material is None or not material.use_nodes or not material.node_tree:
        return False
    return any(node.type in ("VERTEX_COLOR", "ATTRIBUTE") for node in material.node_tree.nodes)


# -- Meshes


def _corner_normals(mesh):
    normals = np.empty(len(mesh.loops) * 3, np.float32)
    if hasattr(mesh, "corner_normals"):
        mesh.corner_normals.foreach_get("vector", normals)
    else:
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", normals)
    return normals.reshape(-1, 3)


def _attribute(mesh, name, vertex):
    """A number a corner, or None."""
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.data_type != "FLOAT" or attribute.domain not in ("POINT", "CORNER"):
        return None
    values = np.empty(len(attribute.data), np.float32)
    attribute.data.foreach_get("value", values)
    return values[vertex] if attribute.domain == "POINT" else values


def _colors(mesh, vertex):
    attributes = mesh.color_attributes
    if not len(attributes):
        return None
    number = attributes.render_color_index
    attribute = attributes[number if 0 <= number < len(attributes) else 0]
    values = np.empty(len(attribute.data) * 4, np.float32)
    attribute.data.foreach_get("color", values)
    codes = np.rint(np.clip(np.nan_to_num(values.reshape(-1, 4)), 0, 1) * 255).astype(np.uint8)
    return codes[vertex] if attribute.domain == "POINT" else codes


def _in_order(uv_layers):
    """The one of the render first."""
    return sorted(uv_layers, key=lambda layer: not layer.active_render)


def _parts(mesh, materials, has_colors):
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    if count == 0:
        return []
    positions = np.empty(len(mesh.vertices) * 3, np.float32)
    mesh.vertices.foreach_get("co", positions)
    if not np.isfinite(positions).all():
        return None
    vertex = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", vertex)
    triangles, numbers = np.empty(count * 3, np.int32), np.empty(count, np.int32)
    mesh.loop_triangles.foreach_get("loops", triangles)
    mesh.loop_triangles.foreach_get("material_index", numbers)
    corners = {"vertex": vertex, "normals": space.vectors(np.nan_to_num(_corner_normals(mesh)))}
    for layer, name in zip(_in_order(mesh.uv_layers), ("uv0", "uv1")):
        uv = np.empty(len(mesh.loops) * 2, np.float32)
        layer.data.foreach_get("uv", uv)
        uv = np.nan_to_num(uv.reshape(-1, 2), posinf=0, neginf=0)
        uv[:, 1] = 1 - uv[:, 1]
        corners[name] = uv
    if has_colors and (colors := _colors(mesh, vertex)) is not None:
        corners["colors"] = colors
    for name, attribute, most in (("warpScales", "_WARP", 64), ("roundness", "_ROUND", 1)):
        if (values := _attribute(mesh, attribute, vertex)) is not None:
            corners[name] = np.clip(np.nan_to_num(values), 0, most)
    return meshes.parts(corners, space.vectors(positions.reshape(-1, 3)), triangles.reshape(-1, 3), numbers, materials)


def _mesh_key(evaluated):
    """Objects that show the same data in the same way share a mesh."""
    original = evaluated.original
    data = original.data
    is_own = (original.type != "MESH" or len(original.modifiers) > 0 or data.shape_keys is not None
              or any(slot.link == "OBJECT" for slot in original.material_slots))
    return "object/" + original.name_full if is_own else "mesh/" + data.name_full


# -- Lamps, cameras, custom properties


def _light(lamp, notes):
    described = {"color": [number(c, 0.0, 1e6) for c in lamp.color], "intensity": number(lamp.energy)}
    if lamp.type == "SUN":
        described["kind"] = "directional"
        return described
    described["intensity"] *= WATTS_TO_LUMENS / (4 * math.pi)
    if lamp.use_custom_distance:
        described["range"] = number(lamp.cutoff_distance)
    if lamp.type == "POINT":
        described["kind"] = "point"
        return described
    described["kind"] = "spot"
    outer = math.pi / 2
    if lamp.type == "SPOT":
        outer = min(lamp.spot_size / 2, outer)
        described["innerCone"] = min(outer * (1 - lamp.spot_blend), outer * 0.999)
    else:
        notes.add(f"the area light '{lamp.name}' is taken as a spot of 180 degrees")
        described["innerCone"] = 0.0
    described["outerCone"] = outer
    return described


def _plain(value, depth=0):
    """A custom property as JSON has it; None for what it has no words for."""
    if depth > DEEPEST or (isinstance(value, float) and not math.isfinite(value)):
        return None
    if isinstance(value, (bool, int, float, str)):
        return value
    if hasattr(value, "to_dict"):
        value = value.to_dict()
    if hasattr(value, "to_list"):
        value = value.to_list()
    if isinstance(value, dict):
        return {str(key): _plain(inner, depth + 1) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(inner, depth + 1) for inner in value]
    return None


def _extras(original):
    return {key: _plain(original[key]) for key in original.keys()
            if key.startswith("scumble_") and _plain(original[key]) is not None}


def camera_view(camera, depsgraph, width, height, engine=None):
    """What a camera sees, as the protocol has a view; its node is the object that it hangs on. With an engine, of
    its active eye."""
    render = depsgraph.scene.render
    evaluated = camera.evaluated_get(depsgraph)
    to_world = np.array(engine.camera_model_matrix(evaluated) if engine else evaluated.matrix_world)
    opengl = np.array(evaluated.calc_matrix_camera(depsgraph, x=width, y=height, scale_x=render.pixel_aspect_x,
                                                   scale_y=render.pixel_aspect_y), np.float64)
    if engine is not None:
        # What the eye adds to the camera's own shift, in parts of the side that the camera's angle is of.
        shift = engine.camera_shift_x(evaluated) - evaluated.data.shift_x
        across = width * render.pixel_aspect_x
        down = height * render.pixel_aspect_y
        fit = evaluated.data.sensor_fit
        side = across if fit == "HORIZONTAL" or (fit == "AUTO" and across >= down) else down
        opengl[0][2] += 2 * shift * side / across
    is_perspective = evaluated.data.type != "ORTHO"
    node = node_key(camera.parent.original) if camera.parent else None
    return space.view(space.without_scale(space.matrix_of_looking(to_world)),
                      space.projection(opengl, evaluated.data.clip_start if is_perspective else None), node)


def notes_of_camera(camera):
    """What of it is not taken over."""
    if camera.data.type == "PANO":
        yield f"the camera '{camera.name}' is panoramic, which is painted as its lens says"
    if camera.data.dof.use_dof:
        yield f"the camera '{camera.name}' has a depth of field, which is not painted"


def region_view(region_data):
    """What a viewport sees."""
    to_world = np.linalg.inv(np.array(region_data.view_matrix, np.float64))
    return space.view(space.without_scale(space.matrix_of_looking(to_world)),
                      space.projection(region_data.window_matrix))


# -- Scenes


def node_key(original):
    return "object/" + original.name_full


class Reader:
    """Reads scenes for one server, and knows what it has read before."""

    def __init__(self):
        self.images = Images()
        self.surfaces = {}  # of meshes: keys of their materials, and whether they have colours

    def read(self, depsgraph, is_known, changed=None):
        return read_scene(depsgraph, self, is_known, changed)


def read_scene(depsgraph, reader, is_known, changed=None):
    """A Description of what an evaluated scene shows, and notes of what could not be taken over.

    is_known(kind, key): whether a server has a mesh or a texture of that key. changed: keys of meshes whose
    vertices may be others than before; None: all may be.
    """
    description, notes = Description(), Notes()
    materials = _Materials(reader.images, description, is_known, notes)
    override = depsgraph.view_layer.material_override
    instances = {}

    def material_key(material, evaluated):
        if material is None:
            return ""
        key = "material/" + material.name_full
        if key not in description.materials:
            layers = getattr(evaluated.data, "uv_layers", ())
            description.materials[key] = materials.describe(material, [layer.name for layer in _in_order(layers)])
        return key

    made = {}

    def made_key(evaluated):
        """Of geometry that nodes have made and placed, which has no name: by the order in which it comes."""
        owner = node_key(evaluated.original)
        return f"{owner}/made/{made.setdefault((owner, evaluated.data.as_pointer()), len(made))}"

    def mesh_key(evaluated, placed):
        is_made = placed is not None and evaluated.data != placed.data
        key = made_key(evaluated) if is_made else _mesh_key(evaluated)
        if key in description.meshes:
            return key
        slots = [override or slot.material for slot in evaluated.material_slots] or [override]
        keys = [material_key(material, evaluated) for material in slots]
        has_colors = any(_uses_colors(material) for material in slots) or not any(slots)
        surface = (tuple(keys), has_colors)
        is_as_it_was = reader.surfaces.get(key) == surface
        reader.surfaces[key] = surface
        if changed is not None and is_as_it_was and not is_made and key not in changed and is_known("meshes", key):
            description.meshes[key] = None
            return key
        mesh = evaluated.to_mesh()
        if mesh is None:
            return ""
        try:
            parts = _parts(mesh, keys, has_colors)
        finally:
            evaluated.to_mesh_clear()
        if parts is None:
            notes.add(f"'{evaluated.name}' has vertices that lie nowhere, and is left out")
        if not parts:
            return ""
        description.meshes[key] = parts
        return key

    def matrix_of(evaluated, world):
        is_looking = evaluated.type in ("LIGHT", "CAMERA")
        return space.matrix_of_looking(world) if is_looking else space.matrix(world)

    shown, worlds = {}, {}
    for instance in depsgraph.object_instances:
        evaluated = instance.object
        original = evaluated.original
        if original.type not in (*PAINTED, "LIGHT", "EMPTY", "ARMATURE", "CAMERA", "LATTICE", "SPEAKER"):
            if original.type not in ("LIGHT_PROBE",):
                notes.add(f"'{original.name}' is a {original.type.lower()}, which is not taken over")
            continue
        if instance.is_instance:
            if not instance.show_self:
                continue
            parent = instance.parent.original if instance.parent else None
            what = _shown(evaluated, mesh_key, instance.instance_object, notes)
            key = "/".join((node_key(parent) if parent else "", node_key(original), what["mesh"]))
            _, _, _, matrices = instances.setdefault(key, (original.name, parent, what, []))
            matrices.append(matrix_of(evaluated, instance.matrix_world))
        else:
            shown[node_key(original)] = (original, instance.show_self, _shown(evaluated, mesh_key, None, notes))
            worlds[node_key(original)] = matrix_of(evaluated, evaluated.matrix_world)

    def add(key, name, parent, world, what):
        if not np.isfinite(world).all():
            notes.add(f"'{name}' lies nowhere, and is left out")
            world, what = np.eye(4), {**what, "mesh": "", "light": {"kind": "none"}}
        above = worlds.get(parent) if parent else None
        inverse = space.inverse(above) if above is not None else None
        if above is not None and inverse is None:
            parent, above = "", None
        description.nodes[key] = {"name": name, "parent": parent,
                                  "transform": space.columns(inverse @ world if above is not None else world), **what}

    def place(key):
        if key in description.nodes:
            return
        original, is_shown, what = shown[key]
        parent = node_key(original.parent) if original.parent else ""
        if parent in shown:
            place(parent)
        else:
            parent = ""
        if original.type in PAINTED and (original.is_holdout or not original.visible_camera):
            notes.add(f"'{original.name}' is a holdout, or hidden from cameras, and is painted all the same")
        if not is_shown:
            what = {"mesh": "", "light": {"kind": "none"}}
        extras = _extras(original)
        settings = getattr(original, "scumble", None)
        if settings is not None and settings.is_ocean:
            extras["scumble_ocean"] = True
        add(key, original.name, parent, worlds[key], {**what, "extras": extras})

    for key in shown:
        place(key)
    for key, (name, parent, what, matrices) in instances.items():
        matrices = [matrix for matrix in matrices if np.isfinite(matrix).all()]
        above = node_key(parent) if parent else ""
        if above not in shown:
            above = ""
        inverse = space.inverse(worlds[above]) if above else None
        relative = [inverse @ matrix for matrix in matrices] if inverse is not None else matrices
        if inverse is None:
            above = ""
        if what["light"]["kind"] == "none":
            if not what["mesh"]:
                continue
            description.nodes[key] = {
                "name": name, "parent": above, "transform": space.columns(np.eye(4)), **what,
                "extras": {}, "instances": np.array([m.T for m in relative], np.float32)}
        else:
            for number, matrix in enumerate(relative):
                description.nodes[f"{key}/{number}"] = {
                    "name": name, "parent": above, "transform": space.columns(matrix), **what,
                    "extras": {}}
    return description, notes.lines


def _shown(evaluated, mesh_key, placed, notes):
    """What a node of this object shows. placed: the object that an instance is one of, or None."""
    what = {"mesh": "", "light": {"kind": "none"}}
    if evaluated.type == "LIGHT":
        what["light"] = _light(evaluated.data, notes)
    elif evaluated.type in PAINTED:
        settings = getattr(evaluated.original, "scumble", None)
        if settings is None or not settings.is_ocean:
            what["mesh"] = mesh_key(evaluated, placed)
    return what


def changed_meshes(depsgraph):
    """Keys of meshes that an update of the depsgraph may have changed."""
    changed = set()
    for update in depsgraph.updates:
        original = update.id.original if hasattr(update.id, "original") else update.id
        if isinstance(original, bpy.types.Object) and update.is_updated_geometry:
            changed.add("object/" + original.name_full)
            if original.data is not None:
                changed.add("mesh/" + original.data.name_full)
        elif isinstance(original, bpy.types.Mesh):
            changed.add("mesh/" + original.name_full)
    return changed


def empties_of(depsgraph):
    """Originals of empties that are shown, with their places in the world, in the order of their names."""
    found = [(instance.object.original, np.array(instance.object.matrix_world, np.float64))
             for instance in depsgraph.object_instances
             if not instance.is_instance and instance.object.type == "EMPTY" and instance.show_self]
    return sorted(found, key=lambda entry: entry[0].name)
