"""What a renderer gives."""

from __future__ import annotations

import copy
import os
import tempfile
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _scumble
from ._errors import UsageError

if TYPE_CHECKING:
    from ._scumble import Drawing

CRYPTOMATTE = "cryptomatte"


class Frame(dict[str, np.ndarray[Any, np.dtype[Any]]]):
    """A finished frame: arrays by name, "picture" and the AOVs that were asked for.

    Each is height by width by channels, float32 unless another dtype was asked for; with more than one view, views by height by
    width by channels (of "shadow-map", which all views share, without the first axis). The memory is the renderer's own: nothing
    is copied for one view. In a notebook a frame shows itself.

    channels: names of each array's channels, such as ("R", "G", "B", "A"). colors: names of the arrays that are colours, of which
    "A" is the coverage. views: how many. objects and materials: what numbers in the AOVs "id" and "cryptomatte" mean: number n is
    entry n - 1. drawings: one a view, where drawing=True. stats: what the frame took, milliseconds and bytes.
    """

    def __init__(self, made: _scumble._Made, views: int) -> None:
        arrays, channels, colors, objects, materials, drawings, stats = made
        super().__init__(arrays)
        self.channels: dict[str, tuple[str, ...]] = channels
        self.colors: list[str] = colors
        self.views: int = views
        self.objects: list[str] = objects
        self.materials: list[str] = materials
        self.drawings: list[Drawing] = drawings
        self.stats: dict[str, Any] = stats

    def eye(self, view: int, name: str = "picture") -> np.ndarray[Any, np.dtype[Any]]:
        """One view's array: height by width by channels."""
        if not -self.views <= view < self.views:
            raise IndexError(f"there are {self.views} views, and no {view}")
        array = self[name]
        return array[view] if array.ndim == 4 else array

    def image(self, name: str = "picture") -> np.ndarray[Any, np.dtype[Any]]:
        """All views side by side: height by width by channels."""
        array = self[name]
        return np.concatenate(list(array), axis=1) if array.ndim == 4 else array

    def save(self, path: str | os.PathLike[str], *, quality: int | None = None) -> None:
        """Writes a .png, .jpg or .webp of the picture, with two eyes side by side, or an .exr of everything.

        An EXR has the picture as R, G, B, A, each AOV as a layer of its name (but "shadow-map", whose size is its own), and two
        eyes as views. quality: of .jpg 1 to 100 (92), of .webp 0 to 100 (90).
        """
        path = os.fsdecode(path)
        if not path.lower().endswith(".exr"):
            _scumble.write_picture(path, self.image(), quality)
            return
        if quality is not None:
            raise UsageError("an EXR has no quality")
        if self.views > 2:
            raise UsageError("an EXR has one view or two")
        size = self.eye(0).shape[:2]
        layers = []
        for name, array in self.items():
            if self.eye(0, name).shape[:2] != size:
                continue  # the shadow map: layers of a file have one size
            for view in range(self.views):
                layers.append(("" if name == "picture" else name, ("left", "right")[view] if self.views == 2 else "",
                               self.eye(view, name), list(self.channels[name]), name in self.colors))
        _scumble._write_exr(path, layers, {CRYPTOMATTE: self.objects} if CRYPTOMATTE in self else {})

    def copy(self) -> Frame:
        """Another one with the same arrays."""
        return copy.copy(self)

    def _repr_png_(self) -> bytes:
        with tempfile.TemporaryDirectory(prefix="scumble_") as folder:
            path = os.path.join(folder, "picture.png")
            _scumble.write_picture(path, self.image())
            with open(path, "rb") as file:
                return file.read()

    def __repr__(self) -> str:
        shapes = ", ".join(f"{name}: {'x'.join(map(str, array.shape))} {array.dtype}" for name, array in self.items())
        return f"<scumble.Frame {shapes}>"
