"""Files of which some bytes of the head are changed: a right answer, or one line."""

import io
import zipfile

import numpy as np

import roughline as rl
from roughline.topography.files.read import measurement
from roughline.units import metres_per

_SIGNS = b"0123456789.,;:=-+eE \t\n\r\x00\xff*#mnu"  # which heads and numbers are made of


def mutation(data, head, rng, cuts=True):
    """The bytes of a file, one to three of its first `head` ones changed, or its end cut off."""
    if cuts and rng.random() < 0.1:
        return data[: rng.integers(1, len(data))]
    changed = bytearray(data[:head])
    for _ in range(rng.integers(1, 4)):
        place = rng.integers(len(changed))
        sign = rng.choice(list(_SIGNS)) if rng.random() < 0.6 else rng.integers(256)
        kind = rng.integers(4)
        if kind == 0:
            del changed[place : place + rng.integers(1, 9)]
        elif kind == 1:
            changed.insert(place, sign)
        else:
            changed[place] = sign
    return bytes(changed) + data[head:]


def agrees(found, whole):
    """Whether a measurement has the heights of another one, on whatever scale the head states."""
    if found.kind != whole.kind or found.heights.shape != whole.heights.shape:
        return False
    if (found.unknown != whole.unknown).any():
        return False
    if found.sizes is not None and not all(0 < side < np.inf for side in found.sizes):
        return False
    for unit in filter(None, (found.unit, found.unit_of_sides)):
        assert metres_per(unit) > 0
    heights, others = (np.ma.filled(each.heights, 0)[~whole.unknown] for each in (found, whole))
    largest = np.abs(others).argmax()
    factor = heights[largest] / others[largest]
    return factor > 0 and np.allclose(heights, factor * others, rtol=1e-9, atol=0)


def assert_read_or_refused(folder, name, data, head, seeds, is_right=None, cuts=True):
    """Read changed files: each is what `is_right(found, its bytes)` accepts, or refused in a line.

    By default what is accepted is the heights of the whole file on any scale. Without `cuts` no
    file is cut short, for formats that state no numbers of points.
    """
    path = folder / name
    path.write_bytes(data)
    whole = measurement(path)
    for seed in seeds:
        changed = mutation(data, head, np.random.default_rng(seed), cuts)
        if changed == data:
            continue
        path.write_bytes(changed)
        refusal = None
        try:
            found = measurement(path)
        except rl.InputError as error:
            refusal = str(error)
        if refusal is not None:
            assert "\n" not in refusal, seed
            assert name in refusal, seed
            assert len(refusal) < 400, seed
            continue
        right = is_right(found, changed) if is_right else agrees(found, whole)
        assert right, f"seed {seed}: {found.kind} {found.heights.shape} {found.sizes} {found.unit}"


def mutated(content, head, rng):
    """Bytes some of which, in the head, are others, are gone, or are more."""
    place, length = int(rng.integers(head)), int(rng.integers(1, 9))
    gone, new = ((length, length), (length, 0), (0, length))[rng.integers(3)]
    return content[:place] + rng.bytes(new) + content[place + gone :]


def mutated_part(content, part, rng):
    """An archive of which one part is changed, so that the archive's own checksum is right."""
    changed = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(content)) as before,
        zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as after,
    ):
        for name in before.namelist():
            data = before.read(name)
            after.writestr(name, mutated(data, len(data), rng) if name == part else data)
    return changed.getvalue()


def assert_each_is_read_or_refused_in_one_line(file, content, head, seeds):
    """Read a file whose head, so many bytes or a part of an archive, is changed again and again."""
    change = mutated_part if isinstance(head, str) else mutated
    for seed in seeds:
        file.write_bytes(change(content, head, np.random.default_rng(seed)))
        try:
            body = rl.read(file)
        except rl.RoughlineError as error:
            said = str(error)
        else:
            said = ""
            assert np.isfinite(body.heights).all()
        assert "\n" not in said
        assert len(said) < 300
