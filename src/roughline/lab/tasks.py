"""Where the tasks of the views are: each function loads a module, in the process that computes.

The server knows these functions, and loads nothing that they load.
"""

from __future__ import annotations

from roughline.lab.server.tasks import Task


def warm_up() -> None:
    """Load and compile what tasks need, unless this process was forked from one that has."""
    from roughline.lab.warm import up

    up()


def load_explore_pictures(name: str) -> Task:
    """The pictures of what Explore presses."""
    from roughline.lab.explore import pictures

    task: Task = getattr(pictures, name)
    return task


def load_explore_code(name: str) -> Task:
    """The code of what Explore shows."""
    from roughline.lab.explore import code

    task: Task = getattr(code, name)
    return task


def load_explore_downloads(name: str) -> Task:
    """The files that Explore gives away."""
    from roughline.lab.explore import downloads

    task: Task = getattr(downloads, name)
    return task


def load_measured_file(name: str) -> Task:
    """A file as it is read."""
    from roughline.lab.measured import file

    task: Task = getattr(file, name)
    return task


def load_measured_part(name: str) -> Task:
    """The maps of a part."""
    from roughline.lab.measured import part

    task: Task = getattr(part, name)
    return task


def load_measured_bodies(name: str) -> Task:
    """The bodies that may be pressed."""
    from roughline.lab.measured import bodies

    task: Task = getattr(bodies, name)
    return task


def load_measured_answers(name: str) -> Task:
    """The answers to a question."""
    from roughline.lab.measured import answers

    task: Task = getattr(answers, name)
    return task


def load_measured_documents(name: str) -> Task:
    """Reports and code of answers."""
    from roughline.lab.measured import documents

    task: Task = getattr(documents, name)
    return task


def load_published_fits(name: str) -> Task:
    """The power laws of the paper's data."""
    from roughline.lab.published import fits

    task: Task = getattr(fits, name)
    return task


def load_published_trust(name: str) -> Task:
    """Where the reduced model is trusted."""
    from roughline.lab.published import trust

    task: Task = getattr(trust, name)
    return task
