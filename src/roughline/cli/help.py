"""Help of commands with many options, and lists that it takes from the registries."""

from __future__ import annotations

from typing import Any

from typer.core import TyperCommand, TyperOption


class PanelsFirst(TyperCommand):
    """A command whose help begins with its panels; options without one come last.

    Where its texts say {materials} or {theories}, the help lists what there is.
    """

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the parameters, those without a panel in one of their own."""
        params = super().get_params(ctx)
        for param in params:
            if isinstance(param, TyperOption) and not param.rich_help_panel:
                param.rich_help_panel = "Other options"
        return params

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help, with the lists filled in."""
        self.fill_lists()
        super().format_help(ctx, formatter)

    def fill_lists(self) -> None:
        """Fill the lists into the texts."""
        from roughline.engineering.materials import materials
        from roughline.question.asked import known_theories

        theories = _either(known_theories())
        lists = {"{materials}": ", ".join(sorted(materials())), "{theories}": theories}
        for place, names in lists.items():
            self.epilog = (self.epilog or "").replace(place, names)
            for param in self.params:
                if isinstance(param, TyperOption) and param.help:
                    param.help = param.help.replace(place, names)


def _either(names: Any) -> str:
    """Names with commas, and an "or" before the last."""
    *first, last = names
    return f"{', '.join(first)} or {last}" if first else last
