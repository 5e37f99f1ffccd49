# SPDX-License-Identifier: GPL-3.0-or-later
"""Cryptomatte 1.2.0 as Blender's compositor reads it, from scumble's numbers of objects. Knows nothing of Blender."""
import json

import numpy as np

MASK = 0xFFFFFFFF


def murmur3(text, seed=0):
    """MurmurHash3_x86_32 of a text's UTF-8 bytes."""
    data = text.encode("utf-8")

    def turned(value, bits):
        return ((value << bits) | (value >> (32 - bits))) & MASK

    def mixed(word):
        return (turned((word * 0xCC9E2D51) & MASK, 15) * 0x1B873593) & MASK

    hashed = seed
    whole = len(data) // 4 * 4
    for at in range(0, whole, 4):
        hashed ^= mixed(int.from_bytes(data[at:at + 4], "little"))
        hashed = (turned(hashed, 13) * 5 + 0xE6546B64) & MASK
    if whole < len(data):
        hashed ^= mixed(int.from_bytes(data[whole:], "little"))
    hashed ^= len(data)
    hashed = ((hashed ^ (hashed >> 16)) * 0x85EBCA6B) & MASK
    hashed = ((hashed ^ (hashed >> 13)) * 0xC2B2AE35) & MASK
    return hashed ^ (hashed >> 16)


def identifier(name):
    """The bits of a name's float: neither infinite, nor denormal, nor no number."""
    bits = murmur3(name)
    exponent = (bits >> 23) & 255
    return bits ^ (1 << 23) if exponent in (0, 255) else bits


def layers(ranks, objects):
    """From rows by columns by 8 (number and coverage, four times): two pictures of four channels."""
    bits = np.array([0] + [identifier(name) if name else 0 for name in objects], np.uint32)
    numbers = np.clip(np.rint(ranks[..., 0::2]), 0, len(objects)).astype(np.int64)
    result = ranks.copy()
    result[..., 0::2] = bits.view(np.float32)[numbers]
    return result[..., :4], result[..., 4:]


def metadata(layer, objects):
    """What a file's header says of it: fields and their values."""
    key = f"cryptomatte/{murmur3(layer):08x}"[:19]
    names = sorted({name for name in objects if name})
    return {f"{key}/name": layer, f"{key}/hash": "MurmurHash3_32", f"{key}/conversion": "uint32_to_float32",
            f"{key}/manifest": json.dumps({name: f"{identifier(name):08x}" for name in names}, ensure_ascii=False)}
