"""scumble: pictures and films of glTF scenes that look painted.

    import scumble

    renderer = scumble.Renderer()
    frame = renderer.render(scumble.Scene("boat.glb"), "watercolour", aovs=["depth"])
    frame.save("boat.png")
    frame["depth"]          # numpy: height by width by channels

Arrays are height by width by channels with row 0 at the top, and with two eyes views by height by width by channels. Pictures are linear,
with straight alpha, unless they are asked for as uint8, which is sRGB. Everything that fails raises a subclass of scumble.Error.
Ctrl+C stops what takes long.
"""

from ._errors import Cancelled, Error, InternalError, NoUsableGpu, OutputNotWritten, UnusableFile, UsageError
from ._films import FilmWriter
from ._frames import Frame
from ._renderer import Renderer, devices, make_views, nodes_to_world, played_seconds, steadiness
from ._scumble import (
    Drawing,
    FilmReader,
    Look,
    Scene,
    SceneEditor,
    View,
    __version__,
    aovs,
    knobs,
    look_schema,
    looks,
    orthographic,
    perspective,
    read_picture,
    write_picture,
)

__all__ = [
    "Cancelled", "Drawing", "Error", "FilmReader", "FilmWriter", "Frame", "InternalError", "Look", "NoUsableGpu", "OutputNotWritten", "Renderer", "Scene",
    "SceneEditor", "UnusableFile", "UsageError", "View", "__version__", "aovs", "devices", "knobs", "look_schema", "looks", "make_views", "nodes_to_world",
    "orthographic", "perspective", "played_seconds", "read_picture", "steadiness", "write_picture",
]

# As who they are known.
for _class in (Cancelled, Drawing, Error, FilmReader, FilmWriter, Frame, InternalError, Look, NoUsableGpu, OutputNotWritten, Renderer, Scene, SceneEditor,
               UnusableFile, UsageError, View):
    _class.__module__ = "scumble"
del _class
