"""Colours for LAMMPS input in the manual: comments, strings, variables, commands, numbers."""

from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Number, String, Text


class LammpsLexer(RegexLexer):
    name = "LAMMPS"
    aliases = ["lammps", "LAMMPS"]
    tokens = {
        "root": [
            (r"^(\s*)([a-z_]+\b)", bygroups(Text, Keyword)),
            (r"#.*$", Comment),
            (r'"[^"]*"', String),
            (r"\$(\w|\{\w+\}|\([^)]*\))|\bv_\w+|\b[cf]_\w+(\[\d+\])?", Name.Variable),
            (r"[-+]?\b\d+(\.\d*)?([eE][-+]?\d+)?\b", Number),
            (r"\w+|\s+|.", Text),
        ]
    }


def setup(app):
    app.add_lexer("LAMMPS", LammpsLexer)
    return {"parallel_read_safe": True}
