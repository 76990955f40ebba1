"""The command line, run in the process of the tests."""

import sys

import pytest

from roughline import cli


@pytest.fixture
def invoke(monkeypatch, capsys):
    """Run the command in this process; returns exit code, output and errors."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["roughline", *map(str, arguments)])
        with pytest.raises(SystemExit) as caught:
            cli.main()
        captured = capsys.readouterr()
        return caught.value.code, captured.out, captured.err

    return run
