"""Measures `medial image` on a whole scene, for docs/images.md."""

import os
import subprocess
import time

from .page import table

# The part of the page that is drawn up here.
TITLE = "A whole scene"

SCENE = "satellite/Miriam.A2012270.2050.2km.jpg"

# What the command is told, and what that means.
OPTIONS = [
    ("", ""),
    ("--layers border,delaunay,crust,dual,axis", ""),
    ("--simplify 1", ""),
    ("--smooth-border 1", ""),
    ("--simplify 1 --engine path_tracing", ", the exact axis"),
    ("--method mean_shift", ""),
]

TEXT = """`{name}`, 750 by 975 pixels (0.73 megapixels) of clouds, sea and land that NASA's MODIS saw, is shipped with Cartopy.
All of its regions, with border and axis, in one command; the least time of {rounds} rounds by turns on a machine that others use too, and the most memory of them:

```sh
medial image {name} -o scene.geojson
```

"""

END = """
`scripts/images --write docs/images.md FOLDER` measures this anew on FOLDER/images, which is no part of this repository.
The default method, the analysis of the feature space, is the one that the paper took, and serves whole scenes; mean shift keeps smooth changes of colour together, and takes {ratio:.0f} times as long.
"""

# Text of more megabytes is told.
LARGE = 50


def section(program, folder, data, rounds):
    """The text below the title."""
    scene = data / "images" / SCENE
    found = {}
    for _ in range(rounds):
        for words, _ in OPTIONS:
            one = run([program, "image", scene, *words.split(), "-q", "-o", folder / "scene.geojson"])
            # Line by line: what is held here counts as memory of the next child, as it begins as a copy of this.
            with open(folder / "scene.geojson", "rb") as text:
                one["regions"] = sum(line.count(b'"layer":"border"') for line in text)
            one["text"] = (folder / "scene.geojson").stat().st_size / 1e6
            before = found.setdefault(words, one)
            for name, least in [("seconds", min), ("processor", min), ("memory", max)]:
                before[name] = least(before[name], one[name])
    rows = [["options", "regions", "seconds", "processor seconds", "peak memory"], ["---"] + ["--:"] * 4]
    for words, meaning in OPTIONS:
        one = found[words]
        size = f", {one['text']:.0f} MB of text" if one["text"] > LARGE else ""
        told = f"`{words}`{meaning}{size}" if words else ""
        rows.append([told, f"{one['regions']:,}", f"{one['seconds']:.1f}", f"{one['processor']:.1f}",
                     f"{one['memory']:.0f} MB"])
    ratio = found["--method mean_shift"]["processor"] / found[""]["processor"]
    return TEXT.format(name=scene.name, rounds=rounds) + table(rows) + END.format(ratio=ratio)


def run(words):
    """Runs a program; gives its times in seconds and its largest memory in megabytes."""
    start = time.monotonic()
    child = subprocess.Popen(list(map(str, words)), stdin=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    seconds = time.monotonic() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"error: {words}: status {child.returncode}")
    # Kilobytes of 1024 bytes, as Linux has it.
    return {"seconds": seconds, "processor": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss * 1024 / 1e6}


def put(page, text):
    """A page with another text below the title."""
    head = f"## {TITLE}\n\n"
    before, rest = page.split(head, 1)
    _, after = rest.split("\n## ", 1)
    return f"{before}{head}{text}\n## {after}"
