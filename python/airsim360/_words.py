"""Words for messages."""
from __future__ import annotations

from typing import Iterable


def did_you_mean(word: str, choices: Iterable[str]) -> str:
    """"; did you mean 'nearest'?", or "" where no choice is near."""
    import difflib  # for messages alone
    near = difflib.get_close_matches(word, list(choices), 1)
    return f"; did you mean {near[0]!r}?" if near else ""
