# SPDX-License-Identifier: GPL-3.0-or-later
"""The knobs of looks, from `scumble schema`. Knows nothing of Blender."""
import json
import re
import subprocess
from dataclasses import dataclass, field

# Where knobs may be set, by the schema's names.
SECTIONS = ("materials", "nodes", "colorizers", "decorations", "clips")


@dataclass
class Knob:
    path: str
    kind: str  # toggle, whole, number, vector, color, choice, text
    default: object
    meaning: str
    least: float = None
    most: float = None
    choices: list = field(default_factory=list)

    @property
    def name(self):
        return self.path.replace(".", "_")

    @property
    def block(self):
        return self.path.rpartition(".")[0]

    @property
    def label(self):
        words = re.sub(r"([A-Z])", r" \1", self.path.rpartition(".")[2]).lower()
        return words[:1].upper() + words[1:]

    def text(self, value):
        """As the protocol takes it."""
        if self.kind == "color":
            return "#" + "".join(f"{round(255 * min(max(c, 0.0), 1.0)):02X}" for c in value)
        if self.kind == "vector":
            return [float(x) for x in value]
        if self.kind == "number":
            return float(value)
        return value


def _knob(path, leaf):
    value = leaf["oneOf"][0] if "oneOf" in leaf else leaf
    knob = Knob(path, "text", leaf.get("default"), leaf.get("description", ""))
    kind = value.get("type")
    if kind == "boolean":
        knob.kind = "toggle"
    elif kind in ("integer", "number"):
        knob.kind = "whole" if kind == "integer" else "number"
        knob.least, knob.most = value.get("minimum"), value.get("maximum")
    elif kind == "array":
        knob.kind = "vector"
        items = value.get("items", {})
        knob.least, knob.most = items.get("minimum"), items.get("maximum")
    elif "enum" in value:
        knob.kind, knob.choices = "choice", value["enum"]
    elif isinstance(knob.default, str) and re.fullmatch("#[0-9A-Fa-f]{6}", knob.default):
        knob.kind = "color"
    return knob


def _walk(schema, definitions, prefix=""):
    for name, inner in schema.get("properties", {}).items():
        while "$ref" in inner:
            inner = definitions[inner["$ref"].rpartition("/")[2]]
        path = f"{prefix}{name}"
        if "default" in inner:
            yield _knob(path, inner)
        elif inner.get("type") == "object":
            yield from _walk(inner, definitions, path + ".")


def read(schema):
    """Knobs by section: "scene", "materials", "nodes", "colorizers", "decorations"."""
    definitions = schema.get("$defs", {})
    scene = {**schema, "properties": {name: inner for name, inner in schema["properties"].items()
                                      if name not in SECTIONS}}
    knobs = {"scene": list(_walk(scene, definitions))}
    for section in SECTIONS:
        inner = schema["properties"].get(section, {}).get("additionalProperties", {})
        while "$ref" in inner:
            inner = definitions[inner["$ref"].rpartition("/")[2]]
        knobs[section] = list(_walk(inner, definitions))
    return knobs


def ask(program):
    """From the program itself; raises OSError or ValueError."""
    done = subprocess.run([program, "schema"], capture_output=True, timeout=60, check=False)
    return read(json.loads(done.stdout))


def looks(program):
    """Names and descriptions of those that ship."""
    done = subprocess.run([program, "looks"], capture_output=True, text=True, timeout=60, check=True)
    return [tuple(line.split(None, 1)) for line in done.stdout.splitlines() if line.strip()]
