# SPDX-License-Identifier: GPL-3.0-or-later
"""Scumble as an engine of Blender's: stills, animations, and the viewport."""
import threading
import traceback
import weakref

import bpy
import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d

from . import blender, cryptomatte, settings, space
from .session import Behind, ScumbleError, Session, Sessions

SESSIONS = Sessions()


class Cancelled(Exception):
    pass


def seconds(scene):
    """Frame 0 is at 0 seconds."""
    return (scene.frame_current + scene.frame_subframe) * scene.render.fps_base / scene.render.fps


def session_for(purpose):
    return SESSIONS.get(purpose, settings.program(), settings.arguments())


READER = blender.Reader()  # of the session "final"
VIEWPORTS = weakref.WeakSet()


def tell_all(session, depsgraph):
    """Brings a session's server up to date. Gives the description and what could not be taken over."""
    description, notes = READER.read(depsgraph, session.knows)
    knobs, more = settings.knobs_of(depsgraph, blender.empties_of(depsgraph))
    session.scene.sync(description)
    session.look.sync(settings.look_of(depsgraph.scene), knobs)
    return description, notes + more


def close_all():
    SESSIONS.close()
    for viewport in list(VIEWPORTS):
        viewport.close()


def on_its_node(view, description):
    """A view whose camera hangs on something that is not there hangs on nothing."""
    if view.get("node") not in description.nodes:
        view.pop("node", None)
    return view


class ScumbleEngine(bpy.types.RenderEngine):
    bl_idname = "SCUMBLE"
    bl_label = "Scumble"
    bl_use_preview = False
    bl_use_postprocess = True
    bl_use_eevee_viewport = True  # for the material preview

    _viewport = None

    # -- Stills and animations

    def update_render_passes(self, scene=None, renderlayer=None):
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        for aov in settings.passes_of(renderlayer):
            name, channels, letters, kind = settings.PASSES[aov]
            for each in _names_of(aov, name):
                self.register_pass(scene, renderlayer, each, min(channels, 4), letters, kind)

    def render(self, depsgraph):
        try:
            with session_for("final") as session:
                self._render(session, depsgraph)
        except Cancelled:
            pass
        except ScumbleError as error:
            if error.kind != "cancelled":
                self.fail(str(error))
        except Exception as error:
            traceback.print_exc()
            self.fail(f"the add-on is at fault, please report this: {type(error).__name__}: {error}")

    def fail(self, problem):
        self.report({"ERROR"}, f"scumble: {problem}")
        self.error_set(f"scumble: {problem}")

    def _render(self, session, depsgraph):
        scene, layer = depsgraph.scene, depsgraph.view_layer
        render = scene.render
        # As Blender rounds.
        width, height = (max(side * render.resolution_percentage // 100, 1)
                         for side in (render.resolution_x, render.resolution_y))
        if scene.camera is None:
            raise ScumbleError("the scene has no camera; add one, and make it the active one")
        session.start()
        aovs = settings.passes_of(layer)
        previous = None
        if "motion" in aovs:
            previous = self._frame_before(session, depsgraph, width, height)
        self.update_stats("", "Telling what has changed")
        description, notes = tell_all(session, depsgraph)
        if previous and previous.pop("nodesEver") != session.count()["nodesEver"]:
            # What came since has a place in the frame before, now that the server has met it.
            previous = self._frame_before(session, depsgraph, width, height)
            previous.pop("nodesEver")
            description, notes = tell_all(session, depsgraph)
        self.warn([*notes, *blender.notes_of_camera(scene.camera)])
        if self.is_unwanted():
            raise Cancelled
        eyes = self._eyes(render)
        views = [on_its_node(view, description) for view in self._views(eyes, scene, depsgraph, width, height)]
        options = {"samples": int(scene.scumble.samples), "seed": scene.scumble.seed,
                   "transparent": render.film_transparent}
        if previous:
            options["previous"] = previous
        region = None
        if render.use_border:
            left, right = (int(np.float32(width) * np.float32(x)) for x in (render.border_min_x, render.border_max_x))
            bottom, top = (int(np.float32(height) * np.float32(y)) for y in (render.border_min_y, render.border_max_y))
            if right > left and top > bottom:
                region = [left, height - top, right - left, top - bottom]
        self.update_stats("", "Painting")
        pictures, done = session.render([width, height], views, seconds(scene), aovs, region,
                                        is_unwanted=self.is_unwanted, tell=self.update_progress, **options)
        self.warn(done["warnings"])
        x, y, w, h = (0, 0, region[2], region[3]) if region else (0, 0, width, height)
        for number, eye in enumerate(eyes):
            result = self.begin_result(x, y, w, h, layer=layer.name, view=eye)
            passes = result.layers[0].passes
            _fill(passes, "Combined", _premultiplied(pictures["picture"][number]), eye)
            for aov in aovs:
                for name, picture in _as_passes(aov, pictures[aov][number], done, layer.name, self.get_result()):
                    _fill(passes, name, picture, eye)
            self.end_result(result)

    def is_unwanted(self):
        """Whether somebody has pressed Esc."""
        return self.test_break()

    def warn(self, notes):
        for note in notes:
            self.report({"WARNING"}, f"scumble: {note}")

    @staticmethod
    def _eyes(render):
        if not render.use_multiview:
            return [""]
        return [view.name for view in render.views if view.use] or [""]

    def _views(self, eyes, scene, depsgraph, width, height):
        for eye in eyes:
            if eye:
                self.active_view_set(eye)
            yield blender.camera_view(scene.camera, depsgraph, width, height, self if eye else None)

    def _frame_before(self, session, depsgraph, width, height):
        """Has the server remember the scene of the frame before, for what moves."""
        scene = depsgraph.scene
        frame, subframe = scene.frame_current, scene.frame_subframe
        self.frame_set(frame - 1, subframe)
        try:
            description, _ = tell_all(session, depsgraph)
            session.remember()
            views = [on_its_node(view, description)
                     for view in self._views(self._eyes(scene.render), scene, depsgraph, width, height)]
            return {"time": seconds(depsgraph.scene), "views": views, "remembered": True,
                    "nodesEver": session.count()["nodesEver"]}
        finally:
            self.frame_set(frame, subframe)

    # -- The viewport

    def _shown(self):
        if self._viewport is None:
            self._viewport = Viewport()
            # Blender takes away what an engine is before Python is asked.
            weakref.finalize(self, self._viewport.close)
        return self._viewport

    def view_update(self, context, depsgraph):
        self._shown().update(depsgraph)

    def view_draw(self, context, depsgraph):
        viewport = self._shown()
        if viewport.is_behind:
            viewport.update(depsgraph)
        region = context.region
        region_data = context.region_data
        viewport.look_from(blender.region_view(region_data), region.width, region.height, depsgraph)
        texture, words = viewport.texture()
        self.update_stats("", f"scumble: {words}" if words else "")
        if texture is not None:
            bind = getattr(self, "bind_display_space_shader", None)
            gpu.state.blend_set("ALPHA_PREMULT")
            if bind:
                bind(depsgraph.scene)
            draw_texture_2d(texture, (0, 0), region.width, region.height)
            if bind:
                self.unbind_display_space_shader()
            gpu.state.blend_set("NONE")
        if viewport.is_busy:
            self.tag_redraw()


class Viewport:
    """What one viewport shows, by a server of its own: others may show other scenes, layers, or parts. Blender's thread
    describes; a thread of this one asks the server, and waits for it."""

    def __init__(self):
        self.session = Session(settings.program(), settings.arguments())
        self._reader = blender.Reader()
        self._condition = threading.Condition()
        self._description = self._look = self._wanted = None
        self._drawn = None  # what the last picture is of
        self._picture = self._texture = None
        self._problem, self._notes = "", []
        self._is_closed = self._is_working = False
        self._reads_all = True  # next time
        self.is_behind = True  # and that should be now
        VIEWPORTS.add(self)
        threading.Thread(target=self._work, daemon=True).start()

    @property
    def is_busy(self):
        with self._condition:
            return self._is_working or self.is_behind or self._wanted is not None or self._picture is not None

    def close(self):
        with self._condition:
            self._is_closed = True
            self._condition.notify()

    def update(self, depsgraph):
        program, arguments = settings.program(), tuple(settings.arguments())
        if (self.session.program, self.session.arguments) != (program, arguments):
            threading.Thread(target=self.session.close, daemon=True).start()  # which may wait for a frame
            self.session = Session(program, arguments)
            self._reads_all = True
        changed = None if self._reads_all else blender.changed_meshes(depsgraph)
        with self._condition:
            pending = self._description

        def is_known(kind, key):
            inside = getattr(pending, kind).get(key) if pending else None
            return inside is not None or self.session.knows(kind, key)

        description, notes = self._reader.read(depsgraph, is_known, changed)
        knobs, more = settings.knobs_of(depsgraph, blender.empties_of(depsgraph))
        with self._condition:
            if self._description is not None:
                description.keep_from(self._description)
            self._description, self._look = description, (settings.look_of(depsgraph.scene), knobs)
            self._notes = notes + more
            self._reads_all = self.is_behind = False
            self._drawn = None

    def look_from(self, view, width, height, depsgraph):
        scene = depsgraph.scene
        wanted = (view, (width, height), seconds(scene), scene.scumble.seed)
        with self._condition:
            if wanted != self._drawn:
                self._wanted = self._drawn = wanted
                self._condition.notify()

    def texture(self):
        """The newest picture, for Blender's thread; and what there is to be said."""
        with self._condition:
            picture, self._picture = self._picture, None
            words = self._problem or (self._notes[0] if self._notes else "")
        if picture is not None:
            height, width, _ = picture.shape
            rows = np.ascontiguousarray(picture[::-1], np.float32).reshape(-1)
            self._texture = gpu.types.GPUTexture((width, height), format="RGBA16F",
                                                 data=gpu.types.Buffer("FLOAT", width * height * 4, rows))
        return self._texture, words

    def _work(self):
        while True:
            with self._condition:
                while not self._is_closed and self._wanted is None:
                    self._condition.wait()
                if self._is_closed:
                    break
                wanted, self._wanted = self._wanted, None
                description, look, session = self._description, self._look, self.session
                self._description = None
                self._is_working = True
            picture, problem, reads_all, is_behind = None, "", False, False
            try:
                with session:
                    session.start()
                    if description is not None:
                        session.scene.sync(description)
                        session.look.sync(*look)
                    elif not session.is_whole:
                        raise Behind
                    view, size, time, seed = wanted
                    pictures, _ = session.render(size, [view], time, samples=1, seed=seed)
                picture = _premultiplied(pictures["picture"][0])
            except Behind:
                reads_all = is_behind = True
            except Exception as error:  # a thread's last word would be heard by nobody
                # All is told anew when something changes, and not at once: what went wrong may do so again.
                problem, reads_all = str(error) or type(error).__name__, True
            with self._condition:
                self._is_working = False
                self._reads_all = self._reads_all or reads_all
                self.is_behind = self.is_behind or is_behind
                self._problem = problem
                if picture is not None:
                    self._picture = picture
        self.session.close()


# -- Pictures as passes


def _names_of(aov, name):
    return [name + "00", name + "01"] if aov == "cryptomatte" else [name]


def _premultiplied(picture):
    if not (picture[..., 3] < 1).any():
        return picture
    result = picture.copy()
    result[..., :3] *= picture[..., 3:]
    return result


def _as_passes(aov, picture, done, layer, result):
    name, channels, _, _ = settings.PASSES[aov]
    if aov == "cryptomatte":
        for field, value in cryptomatte.metadata(f"{layer}.{name}", done["objects"]).items():
            result.stamp_data_add_field(field, value)
        return list(zip(_names_of(aov, name), cryptomatte.layers(picture, done["objects"])))
    if aov == "depth":
        picture = np.where(np.isfinite(picture), picture, np.float32(1e10))
    elif aov in ("position", "normal"):
        picture = space.vectors_back(picture)
    elif aov == "motion":
        # Where it was, less where it is, y upwards; and as much on to where it will be.
        back = np.stack([-picture[..., 0], picture[..., 1]], axis=-1)
        picture = np.concatenate([back, back], axis=-1)
    elif any(each["name"] == aov and each["isColor"] for each in done["layers"]):
        picture = _premultiplied(picture)
    missing = channels - picture.shape[-1]
    if missing > 0:
        picture = np.concatenate([picture, np.zeros((*picture.shape[:2], missing), np.float32)], axis=-1)
    return [(name, picture)]


def _fill(passes, name, picture, eye):
    target = passes.find_by_name(name, eye)
    if target is None:
        return
    target.rect.foreach_set(np.ascontiguousarray(picture[::-1], np.float32).reshape(-1, picture.shape[-1]))
