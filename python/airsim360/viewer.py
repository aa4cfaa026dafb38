"""Datasets and worlds in the browser: the command `airsim360 view` from Python (docs/guide/viewer.md)."""
from __future__ import annotations

import atexit
import json
import os
import re
import shutil
import subprocess
import tempfile
import urllib.request
from pathlib import Path
from types import TracebackType
from typing import Optional, Union

from .dataset import Dataset, Frame

__all__ = ["Viewer", "show"]


def _program() -> str:
    """The program: $AIRSIM360, that of the build folder this package lies in, or the one in $PATH."""
    built = Path(os.path.abspath(__file__)).parents[2] / "bin/airsim360"
    found = os.environ.get("AIRSIM360") or (str(built) if built.is_file() else shutil.which("airsim360"))
    if not found:
        raise RuntimeError("the program airsim360 is not here: run `make build`, or set AIRSIM360 to its path")
    return found


class Viewer:
    """A running viewer: `url` is its page. In Jupyter it is drawn as the page itself. Ends with close(), with the `with`
    block, or with Python."""

    def __init__(self, arguments: list[str], height: int) -> None:
        self.height = height
        log = tempfile.TemporaryFile("w+")  # a pipe that nobody reads would fill
        self._process = subprocess.Popen([_program(), "view", "--port", "0", *arguments], stdout=subprocess.PIPE, stderr=log, text=True)
        assert self._process.stdout is not None
        found = re.fullmatch(r"listening on (http://127\.0\.0\.1:\d+)\n", self._process.stdout.readline())
        if not found or not self._opened(found[1]):
            status = self._process.wait()
            self._process.stdout.close()
            log.seek(0)
            with log:
                raise (ValueError if status == 2 else RuntimeError)(log.read().strip())
        self._log = log
        self._fragment = ""
        self.address = found[1]
        atexit.register(self.close)

    def _opened(self, address: str) -> bool:
        """Waits until its world is open; False where it could not be opened, of which the program has ended."""
        while self._process.poll() is None:
            try:
                with urllib.request.urlopen(address + "/session.json", timeout=60) as answer:
                    live = json.load(answer)["live"] or {}
            except OSError:
                continue
            if "coming" not in live:
                return "error" not in live
        return False

    @property
    def url(self) -> str:
        return self.address + "/" + self._fragment

    def close(self) -> None:
        """Ends it; once more does nothing."""
        atexit.unregister(self.close)
        if self._process.poll() is None:
            self._process.terminate()
            self._process.wait()
        if self._process.stdout:
            self._process.stdout.close()
        self._log.close()

    def __enter__(self) -> Viewer:
        return self

    def __exit__(self, kind: Optional[type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<airsim360.Viewer {self.url}>"

    def _repr_html_(self) -> str:
        return f'<iframe src="{self.url}" width="100%" height="{self.height}" style="border:0" title="AirSim360 view"></iframe>'


def show(what: Union[str, Path, Dataset, Frame, object], compare: Union[str, Path, Dataset, None] = None, height: int = 640) -> Viewer:
    """Opens a dataset, one of its frames, or a world in the viewer.

    what: a Dataset, a Frame, a World (opened anew by its name), or a path or name as `airsim360 view` takes.
    compare: a second dataset, side by side. height: of the page in a notebook, CSS pixels.
    ValueError for what cannot be shown, RuntimeError where the program is not there.
    """
    fragment = ""
    if isinstance(what, Frame):
        fragment, what = f"#frame={[frame.stem for frame in what.dataset].index(what.stem)}", what.dataset
    if isinstance(what, Dataset):
        arguments = [str(what.folder)]
    elif isinstance(what, Path) or (isinstance(what, str) and os.path.exists(what)):
        arguments = [str(what)]
    else:
        name = what if isinstance(what, str) else getattr(what, "name", None)
        if not isinstance(name, str):
            raise ValueError(f"show: {what!r} is neither a Dataset, a Frame, a World nor a path or name of one")
        arguments = ["--world", name]
    if compare is not None:
        arguments += ["--compare", str(compare.folder if isinstance(compare, Dataset) else compare)]
    viewer = Viewer(arguments, height)
    viewer._fragment = fragment
    return viewer
