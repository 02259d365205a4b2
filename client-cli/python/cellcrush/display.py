"""What a person sees while waiting: a bar in terminals and notebooks; tables in notebooks."""
from __future__ import annotations

import html
import sys
import time
from typing import Any, Iterable, Optional, Sequence


def html_table(rows: Iterable[Sequence[str]], heading: str = "") -> str:
    """A table for a notebook.

    >>> html_table([("state", "RUNNING")])
    '<table><tr><td>state</td><td>RUNNING</td></tr></table>'
    """
    caption = f"<caption style='white-space:nowrap'><b>{html.escape(heading)}</b></caption>" if heading else ""
    cells = ("".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in rows)
    return f"<table>{caption}" + "".join(f"<tr>{row}</tr>" for row in cells) + "</table>"


def notebook_display() -> Optional[Any]:
    """IPython.display in a notebook."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return sys.modules.get("IPython.display") if type(shell).__name__ == "ZMQInteractiveShell" else None


class Bar:
    """A progress bar on a terminal (stderr) or in a notebook; nothing elsewhere. As a context, it ends its line."""

    WIDTH = 24
    INTERVAL_S = 0.2

    def __init__(self, name: str, shown: Optional[bool] = None) -> None:
        self._name = name
        self._display = notebook_display() if shown is not False else None
        self._terminal = not self._display and (sys.stderr.isatty() if shown is None else shown)
        self._handle: Any = None
        self._width, self._next = 0, 0.0

    def __enter__(self) -> "Bar":
        return self

    def __exit__(self, *_: object) -> None:
        if self._terminal and self._width:
            sys.stderr.write("\n")

    def show(self, fraction: float, text: str, last: bool = False) -> None:
        """Draws the bar, at most a few times a second."""
        if time.monotonic() < self._next and not last:
            return
        self._next = time.monotonic() + self.INTERVAL_S
        if self._terminal:
            done = "█" * round(self.WIDTH * fraction)
            line = f"{self._name} {done:░<{self.WIDTH}} {fraction:4.0%}  {text}"
            sys.stderr.write("\r" + line.ljust(self._width) + ("\n" if last else ""))
            sys.stderr.flush()
            self._width = 0 if last else len(line)
        elif self._display:
            bar = f"<progress max='1' value='{fraction:.3f}'></progress>"
            content = self._display.HTML(f"{html.escape(self._name)} {bar} {fraction:.0%}&ensp;{html.escape(text)}")
            if self._handle is None:
                self._handle = self._display.display(content, display_id=True)
            else:
                self._handle.update(content)
