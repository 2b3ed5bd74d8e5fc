"""Values of parameters, in Python and as text."""

from __future__ import annotations

from typing import Any, List, Sequence, Union

#: A number, or the text of an expression in x, y, z and t.
Expression = Union[str, float]

#: Three expressions, or one text for all ("exact", "normal: 0", "0; 0; -1").
Expressions = Union[str, Sequence[Expression]]


def split_outside_parentheses(text: str, separator: str) -> List[str]:
    parts, depth = [""], 0
    for c in text:
        depth += (c == "(") - (c == ")")
        if c == separator and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts]


def _number(text: str, kind: type) -> Any:
    try:
        return kind(text)
    except ValueError:
        return text  # the program says what is wrong with it


def value_of(text: str, type: str) -> Any:
    """The value in Python of a parameter's text."""
    if text == "":
        return "" if type in ("text", "selection") else () if type.startswith("list of") else None
    if type == "boolean":
        return {"true": True, "false": False}.get(text, text)
    if type == "integer":
        return _number(text, int)
    if type in ("real", "expression"):
        return _number(text, float)
    if type == "list of expressions":
        parts = split_outside_parentheses(text, ";" if ";" in text else ",")
        return tuple(_number(part, float) for part in parts) if len(parts) == 3 else text
    if type.startswith("list of"):
        kind = {"list of reals": float, "list of integers": int}.get(type, str)
        return tuple(_number(part, kind) for part in split_outside_parentheses(text, ","))
    return text


def text_of(value: Any, type: str = "text") -> str:
    """A value as the text of a parameter."""
    if value is None:
        return ""
    if isinstance(value, str):
        if any(c in value for c in "#\n\r") or value.endswith("\\"):
            raise ValueError(f"{value!r}: a parameter file cannot contain #, line breaks and a backslash at the end")
        return value
    if isinstance(value, bool) or type == "boolean":
        return "true" if value else "false"
    if hasattr(value, "tolist"):  # numpy
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        separator = "; " if type == "list of expressions" else ", "
        return separator.join(text_of(part) for part in value)
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return repr(value)
