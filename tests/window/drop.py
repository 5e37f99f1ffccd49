#!/usr/bin/env python3
"""Drops files on a window, as a file manager does (the XDND protocol, version 5).

    tests/window/drop.py WINDOW X Y FILE...

Like programs of GTK it offers text/plain before text/uri-list.
"""
import sys
import time
from pathlib import Path

from Xlib import X, display
from Xlib.protocol import event


def main():
    number, x, y = (int(word) for word in sys.argv[1:4])
    uris = "".join(f"{Path(file).absolute().as_uri()}\r\n" for file in sys.argv[4:]).encode()
    screen = display.Display()
    root = screen.screen().root
    target = screen.create_resource_object("window", number)
    source = root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
    atom = screen.intern_atom
    selection, plain, uri_list = atom("XdndSelection"), atom("text/plain"), atom("text/uri-list")
    aware = target.get_full_property(atom("XdndAware"), X.AnyPropertyType)
    assert aware and aware.value[0] >= 5, "the window takes no drops"

    def send(name, *data):
        words = [source.id, *data] + [0] * (4 - len(data))
        target.send_event(event.ClientMessage(window=target, client_type=atom(name), data=(32, words)))
        screen.flush()

    def until(condition):
        end = time.monotonic() + 10
        while time.monotonic() < end:
            while screen.pending_events():
                got = screen.next_event()
                if got.type == X.SelectionRequest:
                    assert got.target == uri_list, screen.get_atom_name(got.target)
                    got.requestor.change_property(got.property, uri_list, 8, uris)
                    got.requestor.send_event(event.SelectionNotify(time=got.time, requestor=got.requestor, selection=got.selection,
                                                                   target=got.target, property=got.property))
                elif got.type == X.ClientMessage and condition(got):
                    return
            time.sleep(0.01)
        raise AssertionError("the window does not answer")

    def is_named(name):
        return lambda got: got.client_type == atom(name)

    source.set_selection_owner(selection, X.CurrentTime)
    send("XdndEnter", 5 << 24, plain, uri_list)
    send("XdndPosition", 0, x << 16 | y, X.CurrentTime, atom("XdndActionCopy"))
    until(lambda got: is_named("XdndStatus")(got) and got.data[1][1] & 1)
    send("XdndDrop", 0, X.CurrentTime)
    until(is_named("XdndFinished"))


if __name__ == "__main__":
    main()
