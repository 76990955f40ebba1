"""How many random cases tests try: a fixed share of them in `make test`, and all in `make full`."""

import os

ALL = "ROUGHLINE_FULL" in os.environ


def cases(number, share):
    """Return how many of a number of cases are tried: all of them, or one in `share`."""
    return number if ALL else number // share
