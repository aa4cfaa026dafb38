#!/usr/bin/env python3
"""Checks that every #include between modules follows the layer table of docs/architecture.md.

Usage: check_layers.py [ROOT]. Prints one line per violation and exits 1 if there is any.
Also refuses third-party headers outside the one module that owns them, and in public headers at all.
"""
import pathlib
import re
import sys

OWNERS = {  # third-party header prefix -> modules whose .cc files may include it
    "embree3/": {"trace"},
    "tbb/": {"base"},
    "yaml-cpp/": {"base"},
    "openssl/": {"base"},
    "nlohmann/": {"assets", "dataset", "app"},
    "draco/": {"assets"},
    "meshoptimizer": {"assets"},
    "zip.h": {"assets"},
    "png.h": {"image"},
    "jpeglib.h": {"image"},
    "webp/": {"image"},
    "OpenEXR/": {"image"},
    "Imf": {"image"},
    "sqlite3.h": {"dataset"},
    "CLI/": {"app"},
}


def read_table(root):
    """Module -> set of modules it may include, from the Markdown table."""
    allowed, levels = {}, {}
    for line in (root / "docs/architecture.md").read_text().splitlines():
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


def check(root):
    allowed = read_table(root)
    source = root / "src/airsim360"
    errors = []
    for path in sorted(source.rglob("*")):
        if path.suffix not in {".h", ".cc"}:
            continue
        module = path.relative_to(source).parts[0]
        if module not in allowed:
            errors.append(f"{path}: module '{module}' is not in the table of docs/architecture.md")
            continue
        is_test = path.stem.endswith(("_test", "_fuzz", "_bench"))
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
            if not match:
                continue
            target = match.group(1)
            where = f"{path.relative_to(root)}:{number}"
            if target.startswith("airsim360/"):
                other = target.split("/")[1]
                if other not in allowed[module]:
                    errors.append(f"{where}: {module} must not include {other}")
            for prefix, owners in OWNERS.items():
                if target.startswith(prefix) and not is_test:
                    if module not in owners:
                        errors.append(f"{where}: <{target}> belongs to {', '.join(sorted(owners))}")
                    elif path.suffix == ".h" and module != "app" and not path.stem.endswith("_internal"):
                        errors.append(f"{where}: third-party <{target}> in a public header")
    return errors


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    errors = check(root)
    print("\n".join(errors) if errors else "layers: every include follows docs/architecture.md")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
