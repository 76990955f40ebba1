"""Files for which there is no room."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ASK = """
import roughline as rl
from short_files import short_files
surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, 7)
curve = rl.press(surface, E_star=1.0, forces=[1e-9])
for write in (lambda: rl.write(surface, "body.nc"), lambda: curve.write("curve.nc")):
    try:
        with short_files(20_000):
            write()
    except rl.StoreError as error:
        print(error)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the limit of file sizes is tried on Linux")
@pytest.mark.parametrize("where", ["here", "there"])
def test_a_file_without_room_is_one_line_and_the_process_goes_on(
    where, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    if where == "here":
        exec(ASK, {})
        told = capsys.readouterr().out
    else:
        path = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[1])}
        call = [sys.executable, "-c", ASK]
        done = subprocess.run(call, env=path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        told = done.stdout
    lines = told.splitlines()
    assert [line.split(" (")[0] for line in lines] == [
        "cannot write body.nc",
        "cannot write curve.nc",
    ]
    assert all("File too large" in line for line in lines)
    assert not any(file.stat().st_size for file in tmp_path.iterdir())
