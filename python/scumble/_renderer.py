"""The renderer, and from where it sees."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from . import _scumble
from ._errors import Cancelled, UsageError
from ._films import FilmWriter
from ._frames import Frame
from ._scumble import Look, Scene, View

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, DTypeLike, NDArray

Progress: TypeAlias = "Callable[[float], bool | None]"
LookLike: TypeAlias = "Look | str | os.PathLike[str]"  # itself, or its name or file

BEFORE = 1 / 24  # seconds from a frame to the next, where it is not said
# What says where the camera stands; and what render() takes besides scene, look and progress.
VIEWPOINT = ("camera", "frame", "orbit", "turntable", "eye", "target", "roll", "fov")
FRAME = (*VIEWPOINT, "size", "samples", "aovs", "dtypes", "stereo", "ipd", "views", "seed", "transparent", "background", "drawing")


def devices(choice: str | int = "", *, cache: str | os.PathLike[str] = "") -> list[dict[str, Any]]:
    """Every Vulkan device, each a dict: name, driver, api_version, cpu, unusable_because, would_be_used (for this choice, as
    Renderer takes it), workarounds."""
    return _scumble._devices(str(choice), os.fsdecode(cache))


def _look(look: LookLike) -> Look:
    """A look that nobody else changes."""
    if isinstance(look, Look):
        return look.copy()
    if isinstance(look, (str, os.PathLike)):
        return Look(look)
    raise TypeError(f"a look cannot be {type(look).__name__}; give a scumble.Look, or its name or file")


def _says_stop(answer: Any) -> bool:
    return isinstance(answer, (bool, np.bool_)) and not answer


def _viewpoint(options: Any) -> dict[str, Any]:
    return {name: options[name] for name in VIEWPOINT if options.get(name) is not None}


def make_views(scene: Scene, look: LookLike = "age-of-sail", time: float = 0, *, aspect: float = 16 / 9, stereo: bool = False, ipd: float = 0.063,
               camera: str | int | None = None, frame: str | None = None, orbit: Sequence[float] | None = None,
               turntable: float | None = None, eye: ArrayLike | None = None, target: ArrayLike | None = None,
               roll: float | None = None, fov: float | None = None) -> list[View]:
    """One view, or a left and a right one, ipd metres apart, as render() makes them of the same words."""
    viewpoint = dict(camera=camera, frame=frame, orbit=orbit, turntable=turntable, eye=eye, target=target, roll=roll, fov=fov)
    return _scumble._views(scene, viewpoint, aspect, stereo, ipd, _look(look), time)


def played_seconds(scene: Scene, look: LookLike = "age-of-sail") -> float:
    """Seconds after which every clip that a look plays has played once; 0 where none does."""
    return _scumble._played_seconds(scene, _look(look))


def nodes_to_world(scene: Scene, look: LookLike = "age-of-sail", time: float = 0) -> NDArray[np.float64]:
    """Where each node is at a time in seconds: n by 4 by 4, from its own space to the world."""
    return _scumble._nodes_to_world(scene, _look(look), time)


def steadiness(drawings: Sequence[ArrayLike], *, method: str = "somebody", degrees_a_step: float = 0.125) -> dict[str, Any]:
    """How steady pictures of lines are that anybody drew, dark on light, so many degrees apart: drawn (pixels), changes and flickers
    (of those, a degree). method: who drew, for messages."""
    return _scumble._steadiness(method, list(drawings), degrees_a_step)


def _settings(options: dict[str, Any]) -> dict[str, Any]:
    """What the library's RenderOptions are made of."""
    settings = {name: options[name] for name in ("size", "samples", "seed", "drawing", "transparent") if name in options}
    if "size" in settings and not (isinstance(settings["size"], (Sequence, np.ndarray)) and len(settings["size"]) == 2):
        raise UsageError(f"size cannot be {settings['size']!r}; give (width, height), whole numbers from 1 on")
    aovs = options.get("aovs", ())
    settings["aovs"] = aovs if isinstance(aovs, str) else [aov for aov in aovs if aov != "picture"]
    # As numpy has them: types, dtypes and names.
    settings["dtypes"] = {name: dtype if isinstance(dtype, str) else np.dtype(dtype).name for name, dtype in (options.get("dtypes") or {}).items()}
    background = options.get("background")
    if isinstance(background, (str, os.PathLike)):
        background = _scumble.read_picture(background)
    if background is not None:
        settings["background"] = _scumble._Background(background)
    return settings


class _Call:
    """What frames of one scene and look have in common, at whatever time."""

    def __init__(self, scene: Scene, look: Look, options: Any) -> None:
        for name in options:
            if name not in FRAME:
                raise TypeError(f"a frame has no option '{name}'")
        self.scene, self.look = scene, look
        if not isinstance(scene, Scene):
            raise TypeError(f"a scene cannot be {type(scene).__name__}; give a scumble.Scene")
        self.views: list[View] | None = None if options.get("views") is None else list(options["views"])
        self.stereo: bool = options.get("stereo", False)
        self.ipd: float = options.get("ipd", 0.063)
        self.viewpoint = _viewpoint(options)
        self.settings = _settings(options)
        width, height = self.settings.get("size", (1280, 720))
        self.aspect = width / height if height else 1
        if self.views is not None and len({view.size for view in self.views}) > 1:
            raise UsageError("views of several sizes are no one array; draw them one after the other")
        if self.views is not None and (self.viewpoint or self.stereo):
            raise UsageError("views stand beside " + ("stereo" if self.stereo else next(iter(self.viewpoint))) + "; give one of them")

    def views_at(self, time: float) -> list[View]:
        if self.views is not None:
            return self.views
        return _scumble._views(self.scene, self.viewpoint, self.aspect, self.stereo, self.ipd, self.look, time)

    def at(self, time: float, previous: float) -> tuple[list[View], dict[str, Any]]:
        """Views and settings of one time."""
        return self.views_at(time), {**self.settings, "previous_time": previous, "previous_views": self.views_at(previous)}


class Renderer:
    """Draws frames. A frame depends on scene, look, time and views alone: the same call gives the same bytes.

    device: part of a name, a number of devices(), "cpu", "gpu" (any other), or "" for the best. cache: a folder where compiled
    pipelines stay between runs. validation: the Vulkan validation layers look on; validation_messages counts what they say.
    One thread at a time uses a renderer; others run meanwhile, since it does not hold the GIL while it draws.
    """

    def __init__(self, device: str | int = "", *, cache: str | os.PathLike[str] = "", validation: bool = False) -> None:
        self._renderer = _scumble._Renderer(str(device), os.fsdecode(cache), validation)
        self._device = self._renderer.device
        self._frames: object = None  # whose frames are under way

    def _free(self) -> _scumble._Renderer:
        if self._frames is not None:
            raise UsageError("frames() of this renderer are under way; close that iterator, or take all of them, first")
        return self._renderer

    def render(self, scene: Scene, look: LookLike = "age-of-sail", time: float = 0, *, size: tuple[int, int] = (1280, 720), samples: int = 4,
               aovs: Sequence[str] = (), dtypes: Mapping[str, DTypeLike] | None = None, stereo: bool = False, ipd: float = 0.063,
               views: Sequence[View] | None = None, seed: int = 0, transparent: bool = False,
               background: ArrayLike | str | os.PathLike[str] | None = None, drawing: bool = False, previous_time: float | None = None,
               progress: Progress | None = None, camera: str | int | None = None, frame: str | None = None, orbit: Sequence[float] | None = None,
               turntable: float | None = None, eye: ArrayLike | None = None, target: ArrayLike | None = None, roll: float | None = None,
               fov: float | None = None) -> Frame:
        """Draws one frame.

        look: a Look, or its name or file. time: seconds. size: width and height, pixels. samples: 1 or 4 a pixel. aovs: names of
        aovs() that come beside the picture. dtypes: as what arrays come, such as {"picture": "uint8"}: "float32", "float16", or for
        colours "uint8" (sRGB). stereo: two eyes, ipd metres apart. views: from where exactly, instead of a viewpoint. transparent:
        alpha is 0 where nothing is. background: a picture behind everything, an array or a file. drawing: the look's lines as
        strokes, too (Frame.drawings). previous_time: when the frame before is, for the AOV "motion"; None: 1/24 s earlier. progress:
        called with the part that is done while the scene goes to the device and pipelines are compiled; where it returns False,
        Cancelled is raised.

        The viewpoint: camera (a scene's, by name or number), frame (nodes to frame), orbit (azimuth, elevation[, distance]: degrees
        and radii of what is framed), turntable (seconds), eye and target (metres), roll and fov (degrees).
        """
        look = _look(look)
        options = dict(size=size, samples=samples, aovs=aovs, dtypes=dtypes, stereo=stereo, ipd=ipd, views=views, seed=seed,
                       transparent=transparent, background=background, drawing=drawing, camera=camera, frame=frame, orbit=orbit,
                       turntable=turntable, eye=eye, target=target, roll=roll, fov=fov)
        call = _Call(scene, look, options)
        now, settings = call.at(time, time - BEFORE if previous_time is None else previous_time)
        return Frame(self._free().render(scene, look, time, now, settings, progress), len(now))

    def frames(self, scene: Scene, look: LookLike, times: Iterable[float], *, previous_time: float | None = None,
               **options: Any) -> Iterator[Frame]:
        """Frames of many times (seconds), one after the other, faster than one by one: while one is looked at, the next is drawn.

        options: as render() takes them. The frame before each is the one before in times, before the first that of previous_time.
        Until the last frame has come, or the iterator is closed, the renderer is busy.
        """
        return self._drawn(_Call(scene, _look(look), options), iter(times), previous_time)

    def _drawn(self, call: _Call, times: Iterator[float], previous: float | None) -> Iterator[Frame]:
        counts: list[int] = []  # of views of the frames that are under way

        def finish() -> Frame:
            count = counts.pop(0)
            return Frame(self._renderer.finish(), count)

        self._free()
        self._frames = counts
        try:
            for time in times:
                if len(counts) == _scumble._MAX_BEGUN - 1:
                    yield finish()
                now, settings = call.at(time, time - BEFORE if previous is None else previous)
                self._renderer.begin(call.scene, call.look, time, now, settings)
                counts.append(len(now))
                previous = time
            while counts:
                yield finish()
        finally:
            try:
                while self._renderer.frames_begun:  # Ctrl+C may have struck anywhere
                    self._renderer.finish()
            finally:
                self._frames = None

    def film(self, path: str | os.PathLike[str], scene: Scene, look: LookLike = "age-of-sail", *, seconds: float | None = None, fps: float = 24,
             start: float = 0, quality: int | None = None, progress: Progress | None = None, **options: Any) -> None:
        """Makes a film, as `scumble render -o PATH` does: .mp4, .webm or .gif.

        seconds: how long; without it as long as the clips play, or the turntable, or the look's tracks. Two eyes lie side by side.
        options: as render() takes them, but for those that ask for more than the picture.
        """
        look = _look(look)
        for name in ("aovs", "dtypes", "drawing"):
            if name in options:
                raise TypeError(f"a film has no '{name}'")
        if seconds is None:
            seconds = options.get("turntable") or _scumble._played_seconds(scene, look) or look.last_key_time
            if not seconds:
                raise UsageError("nothing moves, so that it is not known how long the film is to be; give seconds")
        if not (0 < seconds < 1e6 and 0.01 <= fps <= 1000):
            raise UsageError(f"a film of {seconds} seconds at {fps} frames a second; give seconds above 0, and fps from 0.01 to 1000")
        count = max(1, round(seconds * fps))
        eyes = 1 + bool(options.get("stereo")) if options.get("views") is None else len(options["views"])
        if eyes > 2:
            raise UsageError(f"a film of {eyes} views; give one or two")
        options = {**options, "dtypes": {"picture": "uint8"}}
        times = (start + i / fps for i in range(count))
        self._free()
        with FilmWriter(path, fps=fps, quality=quality, layout="side-by-side" if eyes == 2 else "mono") as film:
            for i, frame in enumerate(self.frames(scene, look, times, previous_time=start - 1 / fps, **options)):
                film.add(frame)
                if progress is not None and _says_stop(progress((i + 1) / count)):
                    raise Cancelled("the film was stopped")

    def prepare(self, scene: Scene, look: LookLike = "age-of-sail", *, progress: Progress | None = None, **options: Any) -> None:
        """Sends a scene to the device and compiles what frames with these options need, so that none waits later."""
        look = _look(look)
        now, settings = _Call(scene, look, options).at(0, 0)
        self._free().prepare(scene, look, now, settings, progress)

    def panorama(self, scene: Scene, look: LookLike = "age-of-sail", time: float = 0, *, kind: str = "vr180", height: int = 1024,
                 ipd: float = 0.063, knob_height: float = 90, strip: float = 6, samples: int = 4, aovs: Sequence[str] = (),
                 dtypes: Mapping[str, DTypeLike] | None = None, seed: int = 0, progress: Progress | None = None,
                 **viewpoint: Any) -> Frame:
        """A picture all around: "vr180" and "ods" for two eyes (half and whole), "mono360" for one.

        height: pixels of one eye; its width is as much, or for the whole twice as much. knob_height: degrees that stand for a
        picture's height where knobs count pixels at 1080 lines; strip: degrees for which an eye keeps its place.
        """
        look = _look(look)
        # What is framed is seen by a wide angle, as the program has it.
        viewpoint = {"fov": 80, **viewpoint}
        aspect = 1 if kind == "vr180" else 2
        view, before = (_scumble._views(scene, viewpoint, aspect, False, ipd, look, at)[0] for at in (time, time - BEFORE))
        settings = _settings(dict(size=(height * aspect, height), samples=samples, aovs=aovs, dtypes=dtypes, seed=seed))
        settings |= {"previous_time": time - BEFORE, "previous_views": [before]}
        return Frame(self._free().panorama(scene, look, time, view, kind, ipd, knob_height, strip, settings, progress),
                     1 if kind == "mono360" else 2)

    def measure(self, scene: Scene, look: LookLike = "age-of-sail", *, size: tuple[int, int] = (960, 540), samples: int = 1, seed: int = 0,
                ipd: float | None = None, progress: Progress | None = None, **viewpoint: Any) -> dict[str, Any]:
        """How well MetaTexture and its three rivals keep to surfaces and to the screen, as `scumble measure` does: modes, targets and
        what they were measured with (docs/measure.md). Draws some 500 frames."""
        return _scumble._measure(self._free(), scene, _look(look), dict(viewpoint), size, samples, seed, ipd, progress)

    def measure_lines(self, scene: Scene, look: LookLike, aov: str = "ink", *, size: tuple[int, int] = (960, 540), samples: int = 1,
                      seed: int = 0, progress: Progress | None = None, **viewpoint: Any) -> dict[str, Any]:
        """How steady the lines of an AOV are while one walks around the scene: drawn, changes, flickers; and the views."""
        return _scumble._measure_lines(self._free(), scene, _look(look), aov, dict(viewpoint), size, samples, seed, progress)

    def measure_steps(self, scene: Scene, look: LookLike = "age-of-sail", holds: Sequence[int] = (1, 2, 3, 4), *,
                      size: tuple[int, int] = (960, 540), samples: int = 1, seed: int = 0, progress: Progress | None = None,
                      **viewpoint: Any) -> list[dict[str, Any]]:
        """How far poses jump that stand for so many frames at 24 a second, one for each of the holds, as `scumble measure --steps`
        has it (docs/measure.md)."""
        return _scumble._measure_steps(self._free(), scene, _look(look), list(holds), dict(viewpoint), size, samples, seed, progress)

    def graph(self) -> str:
        """The steps of the last frame, for Graphviz."""
        return self._renderer.graph()

    @property
    def device(self) -> str:
        """Its name."""
        return self._device

    @property
    def validation_messages(self) -> int:
        """What the validation layers have said since the start."""
        return self._renderer.validation_messages

    def __repr__(self) -> str:
        return f"<scumble.Renderer on {self.device}>"
