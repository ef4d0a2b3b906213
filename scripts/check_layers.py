#!/usr/bin/env python3
"""Fails when a file includes a layer above its own, or a third-party header outside the files that own it.

Run from anywhere; prints one line a fault, then a summary."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# What each layer of core/ may include besides itself.
MAY_INCLUDE = {
    "base": set(),
    "sh": {"base"},
    "mesh": {"base", "sh"},
    "light": {"base", "sh"},
    "transfer": {"base", "sh", "mesh", "light"},
    "bake": {"base", "sh", "mesh", "light"},
    "view": {"base", "sh", "mesh", "light", "transfer"},
    "pipeline": {"base", "sh", "mesh", "light", "bake", "transfer", "view"},
}
# The data struct of `transfer` is the language that `bake` and others speak; its file formats are not.
EXCEPTIONS = {("bake", "transfer/transfer_set.h")}
# Code outside core/ includes only this header of it.
UMBRELLA = "shbake.h"
UMBRELLA_ONLY = ("cli", "samples", "meshlab_plugin", "stability")
# What else of core/ such a folder may include: the stability table tries the mathematics itself.
BESIDE_UMBRELLA = {"stability": ("sh/", "base/hash.h")}
# Folders outside core/ that others may include, and who may.
SHARED = {"chart": {"chart", "cli", "bench", "tests"}, "stability": {"stability", "cli", "tests"},
          "cli": {"cli", "tests"}, "bench": {"bench", "tests"}}

# The only layers (or folders outside core/) that may include a third-party library, and in core only from .cpp files.
OWNERS = {
    "OpenMesh/": {"mesh"},
    "CGAL/": {"mesh", "light"},
    "embree3/": {"bake", "chart"},
    "OpenImageIO/": {"light", "view"},
    "tbb/": {"base"},
    "nlohmann/": {"light", "transfer", "cli", "chart"},
    "Eigen/": {"bake", "mesh", "view"},
    "CLI/": {"cli", "bench"},
    "vcg/": {"meshlab_plugin"},
    "wrap/": {"meshlab_plugin"},
    "common/": {"meshlab_plugin"},
    "GL/": {"meshlab_plugin"},
}


def faults_of(path):
    """The faults of one file as (line number, what is wrong)."""
    parts = path.relative_to(ROOT).parts
    in_core = parts[0] == "core"
    layer = parts[1] if in_core and len(parts) > 2 else parts[0]
    for number, line in enumerate(path.read_text().splitlines(), 1):
        own = re.match(r'\s*#\s*include "([^"]+)"', line)
        if own:
            target = own[1].split("/")[0]
            if in_core and layer in MAY_INCLUDE and target in MAY_INCLUDE and target != layer:
                if target not in MAY_INCLUDE[layer] and (layer, own[1]) not in EXCEPTIONS:
                    yield number, f"layer {layer} includes {own[1]} of the higher layer {target}"
            if target in SHARED and parts[0] not in SHARED[target]:
                yield number, f"{parts[0]}/ includes {own[1]} of {target}/"
            if layer in UMBRELLA_ONLY and target in MAY_INCLUDE and not own[1].startswith(BESIDE_UMBRELLA.get(layer, ())):
                yield number, f"{layer}/ includes {own[1]} instead of {UMBRELLA}"
        other = re.match(r"\s*#\s*include <([^>]+)>", line)
        if other:
            for prefix, owners in OWNERS.items():
                if not other[1].startswith(prefix) or layer == "tests":
                    continue
                if layer not in owners:
                    yield number, f"<{other[1]}> belongs to {', '.join(sorted(owners))}"
                elif in_core and path.suffix == ".h":
                    yield number, f"<{other[1]}> in a header of core/"


def main():
    files = [p for d in ("core", "stability", "chart", "cli", "samples", "bench", "meshlab_plugin", "tests")
             for p in (ROOT / d).rglob("*") if p.suffix in (".h", ".cpp", ".inc")]
    bad = 0
    for path in sorted(files):
        for number, what in faults_of(path):
            print(f"{path.relative_to(ROOT)}:{number}: {what}")
            bad += 1
    print(f"check_layers: {len(files)} files, {bad} faults")
    return 1 if bad or not files else 0


if __name__ == "__main__":
    sys.exit(main())
