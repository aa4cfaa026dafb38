"""Builds the wheel with scikit-build-core (PEP 517); the settings are in pyproject.toml.

Two things that it does not do by itself: it is found where Debian has it (python3-scikit-build-core of bookworm-backports,
`tools/install_backport.sh`), also from the isolated environments that pip builds in, so that nothing is downloaded; and
all files of the wheel have one date, so that the same sources give the same wheel.
`python3 build_backend.py DIR` writes the wheel to DIR.
"""
import importlib.util
import os
import pathlib
import sys

_DEBIAN = "/usr/lib/python3/dist-packages"
_NEEDED = ["scikit-build-core>=0.10"]

if importlib.util.find_spec("scikit_build_core") is None and os.path.isdir(f"{_DEBIAN}/scikit_build_core"):
    sys.path.append(_DEBIAN)
_FOUND = importlib.util.find_spec("scikit_build_core") is not None
if _FOUND:
    from scikit_build_core import build as _build

    build_sdist = _build.build_sdist
    prepare_metadata_for_build_wheel = _build.prepare_metadata_for_build_wheel


def get_requires_for_build_wheel(config_settings=None):
    return [] if _FOUND else _NEEDED


get_requires_for_build_sdist = get_requires_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    os.environ.setdefault("SOURCE_DATE_EPOCH", "315532800")  # 1980, the first date that a ZIP file can hold
    return _build.build_wheel(wheel_directory, config_settings, metadata_directory)


def main(directory):
    if not _FOUND:
        sys.exit("scikit-build-core is not installed: tools/install_backport.sh python3-scikit-build-core")
    directory = pathlib.Path(directory).resolve()
    directory.mkdir(parents=True, exist_ok=True)
    os.chdir(pathlib.Path(__file__).resolve().parent.parent)
    print(directory / build_wheel(directory))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: build_backend.py DIRECTORY")
    main(sys.argv[1])
