"""The experiments of [VS87, IV] again: tables of times, and plots like Figs. 19 to 32."""

from .run import run, short

# Seconds of processor time for all of them.
LIMIT = 900

HEAD = """# Ridge following, 1987 and now

The experiments of section IV of [VS87](../REFERENCES.md), done again by `scripts/ridge-following --write docs/ridge-following.md`: how long each phase of `ridge_following` takes, with the search of the report (*sorted*) and with a tree (*tree*), which gives the same answers.
Cells have size 0.1; the report does not tell its own. The rules for pairs of edges and for thinning are those of the report.
Times are microseconds on the clock, the least of five runs; *rest* is the search for all medial pixels after the first, with the scan for those that no ridge leads to.
Processor: {processor}.

![Plots of the times below](ridge-following.svg)

What the report says and what is seen here:

- *Edges* (IV.A, Figs. 19 to 23): the time for the rest grows with the number of edges faster than by itself the search would make it, because more and more of the interior counts as medial; thinning grows with it.
- *Area* (IV.B, Figs. 24 to 28): the first pixel takes the same time whatever the area; initialising and the rest grow like the square root, thinning like the area.
- *Holes* (IV.C, Figs. 29 and 30): holes in the place of teeth, with as many concave and convex vertices.
- *Concave vertices* (IV.D, Figs. 31 and 32): a polygon of twenty edges with some vertices flipped inwards.

"""

TITLES = {
    "edges": ("Regular polygons of area 30", "edges"),
    "area": ("Equilateral triangles", "area"),
    "holes": ("Holes instead of teeth", "holes"),
    "concave": ("Flipped vertices of a polygon of twenty edges", "concave vertices"),
}

PHASES = ["initialise", "first", "rest", "thin"]

SEARCHES = ["sorted", "tree"]


def page(program, processor):
    """The page with a table for each experiment."""
    lines = [line.split() for line in run([str(program), "ridge"], LIMIT)[0].splitlines()]
    text = HEAD.format(processor=processor)
    for name, (title, what) in TITLES.items():
        found = {}
        for experiment, value, search, edges, *numbers in lines:
            if experiment == name:
                found.setdefault(int(value), {"edges": edges})[search] = numbers
        columns = [f"{phase}, {search}" for search in SEARCHES for phase in PHASES]
        text += f"## {title}\n\n| {what} | " + " | ".join(columns) + " | pixels found | kept |\n"
        text += "| --: |" + " --: |" * (len(columns) + 2) + "\n"
        for value, of in sorted(found.items()):
            times = [time for search in SEARCHES for time in of[search][:4]]
            text += f"| {value} | " + " | ".join(times) + " | " + " | ".join(of["sorted"][4:]) + " |\n"
        text += "\n"
    return text.rstrip() + "\n"


def read(text):
    """The tables of a page: for each experiment its values, and the times of each search and phase."""
    found, name = {}, None
    for line in text.splitlines():
        if line.startswith("## "):
            name = next(key for key, (title, _) in TITLES.items() if line[3:] == title)
            found[name] = []
        elif name and line.startswith("| ") and line[2].isdigit():
            found[name].append([float(cell) for cell in line.strip("| ").split(" | ")])
    return found


# Size of one plot, and of the room around it.
WIDTH, HEIGHT, GAP, LEFT, TOP = 210, 130, 44, 64, 70

INK, MUTED, GRID = "#263238", "#607d8b", "#eceff1"

COLOURS = {"sorted": "#1976d2", "tree": "#d84315"}


def figure(text):
    """The plots of a page as a picture: a row for each experiment, a column for each phase and for all."""
    tables = read(text)
    columns = [*PHASES, "total"]
    wide = LEFT + len(columns) * (WIDTH + GAP)
    high = TOP + len(tables) * (HEIGHT + 2 * GAP)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" font-family="sans-serif" '
           f'font-size="11" fill="{INK}">', f'<rect width="{wide}" height="{high}" fill="#fff"/>',
           f'<text x="{LEFT}" y="26" font-size="16">Ridge following: microseconds of each phase</text>']
    for k, search in enumerate(SEARCHES):
        out.append(f'<text x="{LEFT + 70 * k}" y="46" fill="{COLOURS[search]}">{search}</text>')
    for row, (name, lines) in enumerate(tables.items()):
        top = TOP + row * (HEIGHT + 2 * GAP)
        out.append(f'<text x="{LEFT}" y="{top + 8}" font-weight="bold">{TITLES[name][0]}</text>')
        for column, phase in enumerate(columns):
            left = LEFT + column * (WIDTH + GAP)
            out += plot(lines, phase, TITLES[name][1], left, top + 30)
    return "\n".join([*out, "</svg>\n"])


def plot(lines, phase, what, left, top):
    """One plot: a line for each search."""
    place = {search: 1 + k * len(PHASES) for k, search in enumerate(SEARCHES)}
    def time(line, search):
        first = place[search]
        if phase == "total":
            return sum(line[first:first + len(PHASES)])
        return line[first + PHASES.index(phase)]
    low, high = lines[0][0], lines[-1][0]
    most = max(time(line, search) for line in lines for search in SEARCHES) or 1.0
    x = lambda value: left + WIDTH * (value - low) / (high - low)
    y = lambda value: top + HEIGHT * (1 - value / most)
    out = [f'<rect x="{left}" y="{top}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="{GRID}"/>',
           f'<text x="{left + 4}" y="{top + 13}">{phase}</text>',
           f'<text x="{left - 4}" y="{top + 9}" text-anchor="end" fill="{MUTED}">{short(most, 2)}</text>',
           f'<text x="{left}" y="{top + HEIGHT + 14}" fill="{MUTED}">{low:.0f}</text>',
           f'<text x="{left + WIDTH}" y="{top + HEIGHT + 14}" text-anchor="end" fill="{MUTED}">{high:.0f} '
           f'{what}</text>']
    for search in SEARCHES:
        points = " ".join(f"{x(line[0]):.1f},{y(time(line, search)):.1f}" for line in lines)
        out.append(f'<polyline points="{points}" fill="none" stroke="{COLOURS[search]}" stroke-width="1.5"/>')
    return out
