"""Damaged files and senseless commands: one line and the right exit code, never more."""

import logging
import random
import resource
import shlex
import zipfile
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

import roughline as rl
from random_cases import cases
from roughline import cli
from roughline.errors import RoughlineError

FILES = (
    "al3d-1.al3d",
    "dektak-1.csv",
    "di-1.di",
    "mitutoyo_mock.xlsx",
    "opd-1.opd",
    "sur-3.sur",
    "xy-1.txt",
)
LARGEST = 3_000_000_000  # of this process with its libraries [bytes]


def damaged(content, chance):
    """One of the ways in which files go wrong."""
    content = bytearray(content)
    kind = chance.randrange(7)
    if kind == 0:  # cut off
        del content[chance.randrange(len(content)) :]
    elif kind == 1:  # bits
        for _ in range(chance.randrange(1, 30)):
            content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    elif kind == 2:  # in the header
        for _ in range(chance.randrange(1, 12)):
            content[chance.randrange(min(600, len(content)))] = chance.randrange(256)
    elif kind == 3:  # numbers of the header as large as can be
        at = chance.randrange(min(600, len(content)))
        content[at : at + 4] = chance.choice([b"\xff\xff\xff\x7f", b"\x00" * 4, b"9999"])
    elif kind == 4:  # a piece is missing
        at = chance.randrange(len(content))
        del content[at : at + chance.randrange(1, 5000)]
    elif kind == 5:  # a piece is there twice
        at = chance.randrange(len(content))
        content[at:at] = content[at : at + chance.randrange(1, 5000)]
    else:  # another file behind the same beginning
        at = chance.randrange(min(2000, len(content)))
        content[at:] = chance.randbytes(chance.randrange(1, 5000))
    return bytes(content)


@pytest.fixture(autouse=True)
def memory_is_bounded():
    yield
    used = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert used < LARGEST, f"{used / 1e9:.1f} GB"


def read_or_refuse(path, missing="harmonic"):
    """Read a damaged file; anything but a body or one line of ours fails the test."""
    assert not logging.root.manager.disable
    try:
        body = rl.read(path, missing=rl.Missing(missing, most=0.95))
    except RoughlineError as error:
        said = str(error)
    else:
        assert np.isfinite(body.heights).all()
        return True
    assert "\n" not in said, repr(said)
    assert len(said) < 700, said
    return False


@pytest.mark.filterwarnings("ignore")  # what the readers and numpy say of nonsense
@pytest.mark.parametrize("name", FILES)
def test_damaged_files(topographies, tmp_path, capfd, caplog, name):
    content, chance = (topographies / name).read_bytes(), random.Random(name)
    path = tmp_path / name
    count = cases(300, share=25)
    read = 0
    for i in range(count):
        path.write_bytes(damaged(content, chance))
        read += read_or_refuse(path, ("harmonic", "nearest")[i % 2])
    assert read < count
    assert capfd.readouterr() == ("", "")
    assert not caplog.records


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("suffix", [".nc", ".npy", ".npz", ".x3p", ".txt", ".csv", ".xyz", ".mat"])
def test_files_of_noise(tmp_path, suffix):
    chance = random.Random(suffix)
    for i in range(cases(240, share=12)):
        path = tmp_path / f"noise{i}{suffix}"
        printable = "0123456789.,;eE+- \t\n#ab"
        path.write_bytes(
            chance.randbytes(chance.randrange(3000))
            if i % 2
            else "".join(chance.choices(printable, k=chance.randrange(3000))).encode()
        )
        read_or_refuse(path)


@pytest.mark.filterwarnings("ignore")
def test_our_own_files_damaged(tmp_path):
    whole = tmp_path / "whole.nc"
    surface = rl.SelfAffine(hurst=0.5, rms_height=1e-6, length=1e-3).surface(32, 1)
    rl.write(rl.Surface(surface.heights, surface.sizes, "m"), whole)
    content, chance, path = whole.read_bytes(), random.Random(1), tmp_path / "hurt.nc"
    for _ in range(cases(1200, share=24)):
        path.write_bytes(damaged(content, chance))
        read_or_refuse(path)


def test_archives_that_unpack_to_too_much(tmp_path):
    for suffix, inside in ((".x3p", "main.xml"), (".xlsx", "xl/workbook.xml"), (".npz", "a.npy")):
        path = tmp_path / f"bomb{suffix}"
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            archive.writestr(inside, b"0" * 2**27)
        with pytest.raises(rl.InputError, match="would unpack to"):
            rl.read(path)
        path.write_bytes(path.read_bytes()[:-30])
        read_or_refuse(path)


WORDS = (
    *("press", "info", "compare", "generate", "campaign", "paper", "run", "status", "export"),
    *("--modulus", "--materials", "--load", "--depth", "--loads", "--unit", "--channel", "--size"),
    *("--trend", "--crop", "--low-pass", "--resample", "--remove-outliers", "--periodic", "--json"),
    *("--theory", "--frequency", "--friction", "--max-missing", "--fill", "--against", "--hurst"),
    *("--length", "--rms-height", "--points", "--seed", "--line", "--roll-off", "--cutoff"),
    *("steel,copper", "steel", "rigid,rigid", "E=1 GPa nu=0.3, rigid", "1 N", "-1 N", "nan N"),
    *("1 MPa", "10", "0", "-3", "1e400 N", "1 parsnip", "inf m", "1 mm", "2 um", "0 um, 1 mm"),
    *("tilt", "none", "persson", "hertz", "0.5", "2", "nan", "", " ", "ä", "%s", "\x00", "../x"),
)


@pytest.mark.filterwarnings("ignore")
def test_senseless_commands(tmp_path, monkeypatch):
    """Random commands: exit codes 0, 1 or 2, and no traceback."""
    monkeypatch.chdir(tmp_path)
    surface = rl.SelfAffine(hurst=0.5, rms_height=1e-6, length=1e-3).surface(16, 1)
    rl.write(rl.Surface(surface.heights, surface.sizes, "m"), tmp_path / "map.nc")
    monkeypatch.setattr("typer.testing._get_command", cache(typer.main.get_command))
    chance, runner = random.Random(3), CliRunner()
    for _ in range(cases(4800, share=24)):
        start = chance.choice(
            [
                [],
                ["press", "map.nc"],
                ["press", "map.nc", "--modulus", "1 GPa"],
                ["info", "map.nc"],
                ["generate", "--out", "new.nc", "--length", "1 mm", "--rms-height", "1 um"],
            ]
        )
        words = [*start, *chance.choices(WORDS, k=chance.randrange(6))]
        if "paper" in words or ("compare" in words[:1] and "--help" not in words):
            continue  # they mean hours of work
        result = runner.invoke(cli.app, words)
        said = shlex.join(words)
        if isinstance(result.exception, RoughlineError):
            assert "\n" not in str(result.exception), said
        else:
            assert result.exit_code in (0, 1, 2), (said, result.exception)
            assert result.exception is None or isinstance(result.exception, SystemExit), (
                said,
                result.exception,
            )
    assert {path.name for path in Path(tmp_path).iterdir()} <= {"map.nc", "new.nc"}
