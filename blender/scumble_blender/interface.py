# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels and operators."""
import bpy
from bpy.props import StringProperty

from . import settings


class SCUMBLE_OT_unset(bpy.types.Operator):
    bl_idname = "scumble.unset"
    bl_label = "As the look has it"
    bl_description = "Takes back what was set here"
    bl_options = {"UNDO", "INTERNAL"}
    owner: StringProperty()
    knob: StringProperty()

    def execute(self, context):
        group = context.path_resolve(self.owner) if self.owner else None
        if group is None:
            return {"CANCELLED"}
        group.property_unset(self.knob)
        group.id_data.update_tag()
        return {"FINISHED"}


class SCUMBLE_OT_plain_colors(bpy.types.Operator):
    bl_idname = "scumble.plain_colors"
    bl_label = "Show colours as painted"
    bl_description = "View transform Standard: others (Filmic, AgX) change colours that a look has chosen"
    bl_options = {"UNDO"}

    def execute(self, context):
        context.scene.view_settings.view_transform = "Standard"
        context.scene.view_settings.look = "None"
        return {"FINISHED"}


class _AddEmpty:
    """Puts an empty at the cursor: `named`, `shown_as`, with one of its settings on, `flag`."""
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        empty = bpy.data.objects.new(self.named, None)
        empty.empty_display_type = self.shown_as
        empty.location = context.scene.cursor.location
        setattr(empty.scumble, self.flag, True)
        context.collection.objects.link(empty)
        for each in context.selected_objects:
            each.select_set(False)
        empty.select_set(True)
        context.view_layer.objects.active = empty
        return {"FINISHED"}


class SCUMBLE_OT_add_ocean(_AddEmpty, bpy.types.Operator):
    bl_idname = "scumble.add_ocean"
    bl_label = "Ocean"
    bl_description = "A painted sea at the cursor's height"
    named, shown_as, flag = "Ocean", "PLAIN_AXES", "is_ocean"


class SCUMBLE_OT_add_colorizer(_AddEmpty, bpy.types.Operator):
    bl_idname = "scumble.add_colorizer"
    bl_label = "Colorizer"
    bl_description = "A region that grades the colours of what is in it, or is seen through it"
    named, shown_as, flag = "Colorizer", "SPHERE", "is_colorizer"


class SCUMBLE_OT_add_decoration(_AddEmpty, bpy.types.Operator):
    bl_idname = "scumble.add_decoration"
    bl_label = "Wake, ripples or splash"
    bl_description = "What decorates the water here"
    named, shown_as, flag = "Splash", "CIRCLE", "is_decoration"


def _add_menu(self, context):
    if context.engine == "SCUMBLE":
        self.layout.separator()
        for operator in (SCUMBLE_OT_add_ocean, SCUMBLE_OT_add_colorizer, SCUMBLE_OT_add_decoration):
            self.layout.operator(operator.bl_idname, icon="BRUSH_DATA")


def _draw_knobs(layout, group, section, owner, prefix=""):
    """Those of a section whose paths begin so, block by block; those that are set can be taken back."""
    layout.use_property_split = True
    block = None
    for knob in settings.KNOBS.get(section, ()):
        if not knob.path.startswith(prefix):
            continue
        if knob.block != block:
            block = knob.block
            layout.label(text=block)
        row = layout.row(align=True)
        is_set = group.is_property_set(knob.name)
        held = row.row(align=True)
        held.active = is_set
        held.prop(group, knob.name)
        if is_set:
            operator = row.operator(SCUMBLE_OT_unset.bl_idname, text="", icon="X", emboss=False)
            operator.owner, operator.knob = owner, knob.name


class _Panel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {"SCUMBLE"}

    @classmethod
    def poll(cls, context):
        return context.engine == "SCUMBLE"


class SCUMBLE_PT_render(_Panel, bpy.types.Panel):
    bl_label = "Look"
    bl_context = "render"

    def draw(self, context):
        layout, scene = self.layout, context.scene
        layout.use_property_split = True
        if settings.PROBLEM:
            layout.label(text=settings.PROBLEM, icon="ERROR")
        column = layout.column()
        column.enabled = not scene.scumble.look_file
        column.prop(scene.scumble, "look")
        layout.prop(scene.scumble, "look_file")
        layout.prop(scene.scumble, "samples")
        layout.prop(scene.scumble, "seed")
        layout.prop(scene.render, "film_transparent")
        if scene.view_settings.view_transform != "Standard":
            layout.operator(SCUMBLE_OT_plain_colors.bl_idname, icon="COLOR")


class SCUMBLE_PT_passes(_Panel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        self.layout.use_property_split = True
        for aov in settings.PASSES:
            self.layout.prop(context.view_layer.scumble, settings.pass_property(aov))


class SCUMBLE_PT_material(_Panel, bpy.types.Panel):
    bl_label = "Look of this material"
    bl_context = "material"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.engine == "SCUMBLE" and context.material is not None

    def draw(self, context):
        _draw_knobs(self.layout, context.material.scumble.knobs, "materials", "material.scumble.knobs")


class SCUMBLE_PT_material_surface(_Panel, bpy.types.Panel):
    bl_label = "Surface"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.engine == "SCUMBLE" and context.material is not None

    def draw(self, context):
        material = context.material
        self.layout.use_property_split = True
        tree = material.node_tree if material.use_nodes else None
        output = tree.get_output_node("ALL") if tree else None
        if output is not None:
            self.layout.template_node_view(tree, output, output.inputs["Surface"])
        else:
            self.layout.prop(material, "diffuse_color")
        self.layout.prop(material, "use_backface_culling")


class SCUMBLE_PT_object(_Panel, bpy.types.Panel):
    bl_label = "Look of this object"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        _draw_knobs(self.layout, context.object.scumble.knobs, "nodes", "object.scumble.knobs")


class SCUMBLE_PT_ocean(_Panel, bpy.types.Panel):
    bl_label = "Ocean"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.object.scumble, "is_ocean", text="")

    def draw(self, context):
        self.layout.active = context.object.scumble.is_ocean
        _draw_knobs(self.layout, context.object.scumble.ocean, "ocean", "object.scumble.ocean")


class _EmptyPanel(_Panel):
    bl_context = "data"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.engine == "SCUMBLE" and context.object is not None and context.object.type == "EMPTY"


class SCUMBLE_PT_colorizer(_EmptyPanel, bpy.types.Panel):
    bl_label = "Colorizer"

    def draw_header(self, context):
        self.layout.prop(context.object.scumble, "is_colorizer", text="")

    def draw(self, context):
        self.layout.active = context.object.scumble.is_colorizer
        self.layout.label(text="Where it is and how large: the empty's. Its shape: how the empty is shown.")
        _draw_knobs(self.layout, context.object.scumble.colorizer, "colorizers", "object.scumble.colorizer")


class SCUMBLE_PT_decoration(_EmptyPanel, bpy.types.Panel):
    bl_label = "Wake, ripples or splash"

    def draw_header(self, context):
        self.layout.prop(context.object.scumble, "is_decoration", text="")

    def draw(self, context):
        self.layout.active = context.object.scumble.is_decoration
        _draw_knobs(self.layout, context.object.scumble.decoration, "decorations", "object.scumble.decoration")


def _block_panels():
    """A panel a block of the scene's knobs, below that of the look."""
    def draw_block(prefix):
        def draw(self, context):
            _draw_knobs(self.layout, context.scene.scumble.knobs, "scene", "scene.scumble.knobs", prefix)
        return draw

    for block in dict.fromkeys(knob.path.partition(".")[0] for knob in settings.KNOBS.get("scene", ())):
        yield type(f"SCUMBLE_PT_block_{block}", (_Panel, bpy.types.Panel),
                   {"bl_label": block, "bl_context": "render", "bl_parent_id": "SCUMBLE_PT_render",
                    "bl_options": {"DEFAULT_CLOSED"}, "draw": draw_block(block + ".")})


_OWN = [SCUMBLE_OT_unset, SCUMBLE_OT_plain_colors, SCUMBLE_OT_add_ocean, SCUMBLE_OT_add_colorizer,
        SCUMBLE_OT_add_decoration, SCUMBLE_PT_render, SCUMBLE_PT_passes, SCUMBLE_PT_material_surface,
        SCUMBLE_PT_material, SCUMBLE_PT_object, SCUMBLE_PT_ocean, SCUMBLE_PT_colorizer, SCUMBLE_PT_decoration]
_classes = []


def _shared_panels():
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", None)
        name = panel.__name__
        if engines and "BLENDER_RENDER" in engines and not name.startswith(("VIEWLAYER_PT_filter",
                                                                            "VIEWLAYER_PT_layer_passes")):
            yield panel


def register():
    _classes[:] = _OWN + list(_block_panels())
    for each in _classes:
        bpy.utils.register_class(each)
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.add("SCUMBLE")
    bpy.types.VIEW3D_MT_add.append(_add_menu)


def unregister():
    bpy.types.VIEW3D_MT_add.remove(_add_menu)
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.discard("SCUMBLE")
    for each in reversed(_classes):
        bpy.utils.unregister_class(each)
    _classes.clear()
