"""Where the tasks of the views are: each function loads modules, in the process that computes.

The server knows these functions, and loads nothing that they load.
"""

from __future__ import annotations

from roughline.lab.server.tasks import Task


def warm_up() -> None:
    """Load and compile what tasks need, unless this process was forked from one that has."""
    from roughline.lab.warm import up

    up()


def explore(name: str) -> Task:
    """What Explore presses, and its code."""
    from roughline.lab.explore import code, pictures

    task: Task = code.code if name == "code" else getattr(pictures, name)
    return task


def explore_downloads(name: str) -> Task:
    """The files that Explore gives away."""
    from roughline.lab.explore import downloads

    task: Task = getattr(downloads, name)
    return task


def measured(name: str) -> Task:
    """A file as it is read, the bodies that may be pressed, and the answers to a question."""
    from roughline.lab.measured import answers, bodies, file, part

    tasks: dict[str, Task] = {
        "look": file.look,
        "prepare": file.prepare,
        "maps": part.maps,
        "bodies": bodies.bodies,
        "answer": answers.answer,
        "compare": answers.compare,
    }
    return tasks[name]


def measured_documents(name: str) -> Task:
    """Reports and code of answers."""
    from roughline.lab.measured import documents

    task: Task = getattr(documents, name)
    return task


def published(name: str) -> Task:
    """The power laws of the paper's data, and where the reduced model is trusted."""
    from roughline.lab.published import fits, trust

    tasks: dict[str, Task] = {"fits": fits.fits, "point": trust.point}
    return tasks[name]
