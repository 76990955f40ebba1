"""What the handbook says of roughline beside other programs, made of measured rows."""

from page import SHOWN, Page
from peer_programs import SMALL, program_of

PEERS = ("ASPHER", "Tamaas", "ContactMechanics")
SAME_AREA = 1e-4  # relative

SAME = """\
All press the same surfaces, free and fractal down to the grid, and are asked for 1e-6, each in its
own measure. Only roughline's times include a stiffness, with every load."""

LARGE_GRIDS = """Every timing is a process of its own that has pressed another grid before:
machine code is loaded, thread pools run, and neither tables, plans of transforms nor memory of the
timed grid are there. Tamaas and ContactMechanics press the smaller grids only."""

SMALL_GRIDS = """Small grids are pressed in a process that has pressed another surface on the same
grid before and then presses this one again and again; the shortest press counts. What a program
keeps from one surface to the next is there, but no load is begun from the pressures of another.
ASPHER's coarsest grid is 64², its default, but 32² where the grid itself is 64²."""

ALL_GRIDS = """All may use as many threads. Programs take turns; the best of the runs counts.
ASPHER counts with the best of its engines at that load: an H² product that touches the candidate
contact only, and FFT; "Fourier" is the former with the preconditioner of the latter, and "single
first" finds the contact in single precision and ends in double. An engine that takes longer than
2 s and longer than another has taken is stopped. Ratios are the other program's time over
roughline's: below one, roughline is slower. A dash stands where a program was not run."""


def write(rows, part):
    """Write the rows into the handbook."""
    page = Page(part, "measured.md", "peers", conditions(rows))
    for section in (head, convolutions, cold_loads, contact_areas, paths):
        section(rows, page)
    page.save()


def of_kind(rows, kind):
    """Return the rows of a kind, by grid, then H, then load."""
    found = [row for row in rows if row["kind"] == kind]
    order = ("n", "hurst", "force_bar", "load")
    return sorted(found, key=lambda row: [row.get(name, 0) for name in order])


def tabled(page, heading, columns, rows, cells_of, said="", at_most=SHOWN):
    """Give a heading and a table under it; nothing where there are no rows."""
    if not rows:
        return
    page.heading(heading)
    if said:
        page.say(said)
    page.table(*columns, at_most=at_most)
    for row in rows:
        page.row(*cells_of(row))


def are_small(rows):
    """Whether all grids are small ones."""
    return all(row["n"] <= SMALL for row in rows if "n" in row)


def conditions(rows):
    """Name the machine and the programs."""
    (machine,) = of_kind(rows, "machine")
    programs = ", ".join(f"{name} {version}" for name, version in machine["programs"].items())
    return (
        f"{programs}; {machine['processor']}, {machine['cores']} cores, {machine['vectors']}; "
        f"Python {machine['python']}, NumPy {machine['numpy']}"
    )


def head(rows, page):
    """Say how times are taken, where it is not said of the large grids."""
    page.say(SMALL_GRIDS if are_small(rows) else f"{SAME} {LARGE_GRIDS} {ALL_GRIDS}")
    page.say(other_work(rows))


def ended(row):
    """Return the runs of a row that were not stopped."""
    return [run for runs in row.get("runs", {}).values() for run in runs if "seconds" in run]


def part_of_others(runs):
    """Return the part of the cores that other work had while programs ran."""
    return sum(run["others"] for run in runs) / sum(run["seconds"] for run in runs)


def other_work(rows):
    found = [runs for row in rows if (runs := ended(row))]
    if not found:
        return ""
    total = part_of_others([run for runs in found for run in runs])
    most = max(part_of_others(runs) for runs in found)
    return (
        f"While they ran, other work had {total:.0%} of the cores, and at most {most:.0%} "
        "during the runs of one row."
    )


def convolutions(rows, page):
    def cells(row):
        times = (f"{row[name] * 1e3:.1f} ms" for name in ("plain", "double", "single"))
        return [f"{row['n']}²", *times]

    columns = ("grid", "plain, zero-padded", "roughline, double", "single")
    tabled(page, "One convolution beside", columns, of_kind(rows, "convolution"), cells, at_most=3)


def best(row, program):
    """Return the label of a program's fastest run and this run, or one that says why none is."""
    runs = [
        (label, run)
        for label, runs in row["runs"].items()
        if program_of(label) == program
        for run in runs
    ]
    certain = [each for each in runs if each[1].get("converged")]
    if certain:
        return min(certain, key=lambda each: each[1]["seconds"])
    return max(runs, key=lambda each: each[1].get("stopped_after", 0), default=("", {}))


def duration(run):
    """Return the time of a run as text, or why there is none."""
    if "seconds" in run:
        seconds = run["seconds"]
        text = f"{seconds:.2f} s" if seconds >= 0.1 else f"{1e3 * seconds:.1f} ms"
        return text if run.get("converged") else f"{text}, not converged"
    if "stopped_after" in run:
        return f"> {run['stopped_after']:.3g} s"
    return "failed" if run else "–"


def ratio(theirs, ours, at_least=False):
    """Return how many times as long another program takes, as text."""
    if theirs is None:
        return "–"
    value = theirs / ours
    text = f"{'> ' if at_least else ''}{value:.2f}"
    return f"{text}, roughline is slower" if value < 1 and not at_least else text


def peers_in(rows):
    labels = {program_of(label) for row in rows for label in row["runs"]}
    return [program for program in PEERS if program in labels]


def time_of(run):
    """Return the seconds that a run took, or after which it was stopped."""
    return run["seconds"] if run.get("converged") else run.get("stopped_after")


def cold_loads(rows, page):
    found = of_kind(rows, "cold")
    peers = peers_in(found)

    def cells(row):
        _, ours = best(row, "roughline")
        yield from (f"{row['n']}²", f"{row['hurst']}", f"{row['force_bar']}")
        yield from (f"{ours['area']:.2%}", duration(ours))
        for peer in peers:
            label, run = best(row, peer)
            engine = label.partition(", ")[2]
            yield duration(run) + (f" ({engine})" if engine and "seconds" in run else "")
            yield ratio(time_of(run), ours["seconds"], "stopped_after" in run)

    initials = {peer: "".join(filter(str.isupper, peer)) for peer in peers}
    columns = [x for peer in peers for x in (peer, f"over roughline ({initials[peer]})")]
    columns = ("grid", "H", "F̄", "contact", "roughline", *columns)
    of_small = " on a small grid" * are_small(rows)
    tabled(page, f"One cold load{of_small}", columns, found, cells, at_most=6)


def contact_areas(rows, page):
    found = of_kind(rows, "cold")
    peers = peers_in(found)

    def cells(row):
        _, ours = best(row, "roughline")
        yield from (f"{row['n']}²", f"{row['hurst']}", f"{row['force_bar']}", f"{ours['area']:.4%}")
        for peer in peers:
            area = best(row, peer)[1].get("area")
            far = area is not None and abs(area / ours["area"] - 1) > SAME_AREA
            yield "–" if area is None else f"{area:.4%}{', differs' if far else ''}"

    columns = ("grid", "H", "F̄", "roughline", *peers)
    runs = [(row["force_bar"], best(row, peer)[1]) for row in found for peer in peers]
    furthest = max((abs(run.get("force", f) / f - 1) for f, run in runs), default=0.0)
    said = (
        f"Areas that differ by more than {SAME_AREA:.0e} of themselves are marked. "
        f"Mean pressures are met to {furthest:.0e}."
    )
    of_small = " on small grids" * are_small(rows)
    heading = f"Contact areas of these loads{of_small}"
    tabled(page, heading, columns, found, cells, said, at_most=0)


def paths(rows, page):
    def cells(row):
        _, ours = best(row, "roughline")
        each, counts = ours["seconds"] / row["n_loads"], ours["convolutions"]
        areas = [f"{100 * area:.2g}%" for area in ours["areas"]]
        yield from (f"{row['n']}²", f"{row['hurst']}", f"{areas[0]} to {areas[-1]}")
        yield from (f"{each:.2f} s", f"{each / row['plain']:.1f}")
        yield f"{sum(counts) / row['n_loads']:.0f}, at most {max(counts)}"
        yield from (*cold_path(rows, row, each), *warm_path(row, each))

    said = (
        "Times are seconds a load, each run once. ASPHER's cold loads are those of roughline's "
        "path, each with the best of its engines; of some paths only every k-th is solved, as the "
        "table says, and one that is stopped counts with the time until then. Its warm loads start "
        "from the pressures of the load before, with its FFT."
    )
    columns = (
        *("grid", "H", "contact", "roughline", "plain convolutions", "own convolutions"),
        *("ASPHER, cold", "cold over roughline", "its loads"),
        *("ASPHER, warm", "warm over roughline"),
    )
    heading = "A path of loads from first touch to saturation"
    tabled(page, heading, columns, of_kind(rows, "path"), cells, said, at_most=3)


def cold_path(rows, path, each):
    same = ("n", "hurst", "n_loads")
    loads = [
        best(row, "ASPHER")[1]
        for row in of_kind(rows, "load")
        if all(row[name] == path[name] for name in same)
    ]
    if not loads:
        return ["–", "–", "–"]
    times = [time_of(load) for load in loads]
    known = [time for time in times if time is not None]
    stopped = any("stopped_after" in load for load in loads)
    mean = sum(known) / len(known) if known else None
    text = "failed" if mean is None else f"{'> ' * stopped}{mean:.2f} s"
    failed = len(times) - len(known)
    count = f"{len(times)} of {path['n_loads']}" + f", {failed} failed" * (failed > 0)
    return [text, ratio(mean, each, stopped), count]


def warm_path(path, each):
    _, run = best(path, "ASPHER")
    time = time_of(run)
    if time is None:
        return [duration(run), "–"]
    mean, stopped = time / path["n_loads"], "stopped_after" in run
    return [f"{'> ' * stopped}{mean:.2f} s", ratio(mean, each, stopped)]
