"""Films that are written picture by picture."""

from __future__ import annotations

import os
from types import TracebackType
from typing import TYPE_CHECKING

from . import _scumble
from ._frames import Frame

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class FilmWriter:
    """Writes a film, .mp4 (H.264), .webm (VP9) or .gif, by the program ffmpeg.

        with scumble.FilmWriter("boat.mp4", fps=24) as film:
            for frame in renderer.frames(scene, look, times):
                film.add(frame)

    The file appears whole when the block is left, and not at all where it is left by an exception. The first picture decides the
    size; there is no alpha. fps: 0.01 to 1000 (a GIF: 50). quality: constant, lower is better: of .mp4 0 to 51 (16), of .webm 0 to
    63 (20). Odd sizes grow by a pixel in both. layout: how two eyes lie in each picture, "mono", "side-by-side" or "over-under";
    projection: "flat", "sphere" or "half-sphere" (Renderer.panorama). Players learn both from an .mp4.
    """

    def __init__(self, path: str | os.PathLike[str], *, fps: float = 24, quality: int | None = None, layout: str = "mono",
                 projection: str = "flat") -> None:
        self._writer = _scumble._FilmWriter(path, fps, quality, layout, projection)

    def add(self, picture: Frame | ArrayLike) -> None:
        """The next picture: a frame (two eyes side by side), or an array as write_picture takes it."""
        self._writer.add(picture.image() if isinstance(picture, Frame) else picture)

    def finish(self) -> None:
        """Ends the film and puts the file in its place."""
        self._writer.finish()

    def __enter__(self) -> FilmWriter:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None:
            self._writer.finish()
        else:
            self._writer.abandon()
