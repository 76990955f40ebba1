"""Figures that are left blank where a test looks at others, as drawing takes most of the time."""

from pathlib import Path


def blank_but(patch, *names):
    """Leave what is saved blank from now on, but for figures of some names."""
    from matplotlib.figure import Figure  # load slowly, so only here
    from PIL import Image

    drawn = Figure.savefig

    def save(figure, path, **options):
        if not isinstance(path, Path) or path.stem in names:
            return drawn(figure, path, **options)
        width, height = (round(20 * side) for side in figure.get_size_inches())
        return Image.new("L", (width, height), 255).save(path, dpi=(20, 20))

    patch.setattr(Figure, "savefig", save)
