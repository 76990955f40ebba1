"""Files for which there is no room."""

import subprocess
import sys

import pytest

ASK = """
import resource, sys
import roughline as rl
surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, 7)
curve = rl.press(surface, E_star=1.0, forces=[1e-9])
resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
for write in (lambda: rl.write(surface, "body.nc"), lambda: curve.write("curve.nc")):
    try:
        write()
    except rl.StoreError as error:
        print(error)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the limit of file sizes is tried on Linux")
def test_a_file_without_room_is_one_line_and_the_process_goes_on(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", ASK], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert [line.split(" (")[0] for line in lines] == [
        "cannot write body.nc",
        "cannot write curve.nc",
    ]
    assert all("File too large" in line for line in lines)
    assert not any(file.stat().st_size for file in tmp_path.iterdir())
