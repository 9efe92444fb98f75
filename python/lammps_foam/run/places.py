"""Where the values of a JSON text stand, for messages as an editor shows them.

The json module reads and judges the text, but forgets where a value stood. Once it has found the text to be right, its
pieces are easily told apart: that is all that happens here.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Union

Path = tuple[Union[str, int], ...]

# a string, a sign, or a number or word
PIECE = re.compile(r'"(?:[^"\\]|\\.)*"|[{}\[\],:]|[^\s{}\[\],:"]+')


@dataclass
class Span:
    """From start to end, in characters of the text."""
    start: int
    end: int


@dataclass
class Node:
    """A value and where it stands; `keys` has the places of an object's keys, once for each time that a key occurs."""
    span: Span
    value: Any
    keys: list[tuple[str, Span]]
    children: dict[str | int, Node]

    def at(self, path: Sequence[str | int]) -> Node:
        node = self
        for name in path:
            node = node.children[name]
        return node


def read(text: str) -> Node:
    """The tree of a JSON text. Raises json.JSONDecodeError where it is none, RecursionError where it is too deep."""
    json.loads(text)
    pieces = list(PIECE.finditer(text))
    node, _ = _value(pieces, 0)
    return node


def _value(pieces: list[re.Match[str]], i: int) -> tuple[Node, int]:
    """The value that begins with piece i, and the number of the piece after it."""
    first = pieces[i]
    if first[0] == "{":
        return _object(pieces, i)
    if first[0] == "[":
        return _array(pieces, i)
    return Node(Span(first.start(), first.end()), json.loads(first[0], strict=False), [], {}), i + 1


def _object(pieces: list[re.Match[str]], i: int) -> tuple[Node, int]:
    node = Node(Span(pieces[i].start(), pieces[i].end()), {}, [], {})
    i += 1
    while pieces[i][0] != "}":
        name = json.loads(pieces[i][0], strict=False)
        node.keys.append((name, Span(pieces[i].start(), pieces[i].end())))
        child, i = _value(pieces, i + 2)    # behind the colon
        node.children[name], node.value[name] = child, child.value
        i += pieces[i][0] == ","
    return node, i + 1


def _array(pieces: list[re.Match[str]], i: int) -> tuple[Node, int]:
    node = Node(Span(pieces[i].start(), pieces[i].end()), [], [], {})
    i += 1
    while pieces[i][0] != "]":
        child, i = _value(pieces, i)
        node.children[len(node.value)] = child
        node.value.append(child.value)
        i += pieces[i][0] == ","
    return node, i + 1


def show(text: str, span: Span) -> tuple[int, int, str]:
    """Line and column, counted from 1, and the line of the text with carets below the span."""
    start = text.rfind("\n", 0, span.start) + 1
    end = text.find("\n", start)
    line = text[start:end if end >= 0 else len(text)].rstrip("\r").replace("\t", " ")
    number = text.count("\n", 0, start) + 1
    column = span.start - start
    carets = "^" * max(1, min(span.end - span.start, len(line) - column))
    if column > 100:    # a whole file in one line
        cut = column - 60
        line, shown = "..." + line[cut:], column - cut + 3
    else:
        shown = column
    if len(line) > 160:
        line, carets = line[:157] + "...", carets[:max(1, 157 - shown)]
    margin = f"{number:5d} | "
    return number, column + 1, f"{margin}{line}\n{' ' * (len(margin) - 2)}| {' ' * shown}{carets}"
