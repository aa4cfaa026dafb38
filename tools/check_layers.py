#!/usr/bin/env python3
"""Checks that every #include between modules follows the layer table of docs/internals/architecture.md, and between the
folders of a module that of docs/internals/folders.md.

Usage: check_layers.py [ROOT]. Prints one line per violation and exits 1 if there is any.
Also refuses third-party headers outside the modules that own them, and in headers that another module includes.
"""
import pathlib
import re
import sys

OWNERS = {  # third-party header prefix -> modules whose .cc files may include it
    "embree3/": {"trace"},
    "tbb/": {"base"},
    "yaml-cpp/": {"base", "assets", "people", "projection"},
    "openssl/": {"base"},
    "nlohmann/": {"assets", "eval", "mpde", "dataset", "opening", "sim", "tasks", "view", "vln", "app"},
    "curl/": {"http"},
    "boost/": {"http", "worlds"},
    "draco/": {"assets"},
    "meshoptimizer": {"assets"},
    "zip.h": {"assets"},
    "png.h": {"image"},
    "jpeglib.h": {"image"},
    "webp/": {"image"},
    "osmium/": {"worlds"},
    "OpenEXR/": {"image"},
    "Imf": {"image"},
    "sqlite3.h": {"dataset"},
    "hdf5.h": {"eval"},
    "CLI/": {"app"},
    "recastnavigation/": {"people"},
    "expat.h": {"behaviour"},
}


def read_table(root):
    """Module -> set of modules it may include, from the Markdown table."""
    allowed, levels = {}, {}
    for line in (root / "docs/internals/architecture.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if len(cells) != 4 or not cells[0].isdigit():
            continue
        level, module, _, includes = cells
        levels[module] = int(level)
        allowed[module] = includes
    for module, includes in allowed.items():
        if includes == "anything":
            names = set(levels)
        elif includes == "all below":
            names = {other for other in levels if levels[other] < levels[module]}
        else:
            names = set(re.findall(r"[a-z]+", includes))
        allowed[module] = names | {module}
    return allowed


def read_folders(root):
    """Folder -> set of folders of its module that it may include, from the table of docs/internals/folders.md."""
    allowed = {}
    for line in (root / "docs/internals/folders.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if len(cells) == 3 and re.fullmatch(r"[a-z0-9_/]+", cells[0]) and re.fullmatch(r"—|[a-z0-9_/ ]+", cells[2]):
            if cells[0] != "folder":
                allowed[cells[0]] = set(cells[2].split()) - {"—"}
    return allowed


def check_folders(root):
    """Includes between folders of one module follow the table of folders, and that table has no cycle."""
    allowed, errors, done = read_folders(root), [], set()

    def visit(folder, path):
        if folder in path:
            errors.append("folders include each other: " + " -> ".join([*path[path.index(folder):], folder]))
        elif folder not in done:
            for other in sorted(allowed.get(folder, ())):
                visit(other, [*path, folder])
            done.add(folder)

    for folder in allowed:
        visit(folder, [])
    source = root / "src/airsim360"
    for path in sorted(source.rglob("*")):
        if path.suffix not in {".h", ".cc"} or path.stem.startswith("test_") or path.stem.endswith(("_test", "_fuzz", "_bench")):
            continue
        folder = str(path.parent.relative_to(source))
        for number, target in includes_of(path):
            other = str(pathlib.PurePath(target).parent).removeprefix("airsim360/")
            if not target.startswith("airsim360/") or other == folder or other.split("/")[0] != folder.split("/")[0]:
                continue
            if other not in allowed.get(folder, ()):
                errors.append(f"{path.relative_to(root)}:{number}: {folder} must not include {other}")
    return errors


def includes_of(path):
    """(line number, included name) of every #include."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if match:
            yield number, match.group(1)


def public_headers(source, files):
    """Headers that a file of another module includes."""
    public = set()
    for path in files:
        for _, target in includes_of(path):
            header = source.parent / target
            if target.startswith("airsim360/") and target.split("/")[1] != path.relative_to(source).parts[0]:
                public.add(header)
    return public


def check(root):
    allowed = read_table(root)
    source = root / "src/airsim360"
    errors = []
    files = [path for path in sorted(source.rglob("*")) if path.suffix in {".h", ".cc"}]
    public = public_headers(source, files)
    for path in files:
        module = path.relative_to(source).parts[0]
        if module not in allowed:
            errors.append(f"{path}: module '{module}' is not in the table of docs/internals/architecture.md")
            continue
        is_test = path.stem.endswith(("_test", "_fuzz", "_bench"))
        for number, target in includes_of(path):
            where = f"{path.relative_to(root)}:{number}"
            if target.startswith("airsim360/"):
                other = target.split("/")[1]
                if other not in allowed[module]:
                    errors.append(f"{where}: {module} must not include {other}")
            for prefix, owners in OWNERS.items():
                if target.startswith(prefix) and not is_test:
                    if module not in owners:
                        errors.append(f"{where}: <{target}> belongs to {', '.join(sorted(owners))}")
                    elif path in public:
                        errors.append(f"{where}: third-party <{target}> in a public header")
    return errors


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    errors = check(root) + check_folders(root)
    print("\n".join(errors) if errors else "layers: every include follows docs/internals/architecture.md")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
